# cmake -P: installs the packages of LISTS/package-lock.json in FOLDER with NPM, unless NO_NPM says why
# not. PROBE is a script that NODE must then be able to run there. Where it cannot be done, FOLDER has no
# node_modules, FOLDER/without.txt says why and what is missing now (WITHOUT), and the build goes on.
file(REMOVE_RECURSE ${FOLDER}/node_modules ${FOLDER}/without.txt)  # half of them must not pass for all
set(why "${NO_NPM}")
if(NOT why)
  file(COPY ${LISTS}/package.json ${LISTS}/package-lock.json DESTINATION ${FOLDER})
  # By itself npm waits for minutes before it gives up, for some packages after others. Whether it must do
  # with its cache is told by one question, about a package that has few versions.
  execute_process(COMMAND ${NPM} view gltf-validator version --fetch-retries=0 --fetch-timeout=20000
                  WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
  set(offline "")
  if(failed)
    set(offline --offline)
    message("npm's registry is out of reach; trying npm's cache")
  endif()
  execute_process(
    COMMAND ${NPM} ci ${offline} --no-audit --no-fund --ignore-scripts --fetch-retries=1
            --fetch-retry-mintimeout=1000 --fetch-timeout=30000
    WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE failed TIMEOUT 600)
  if(failed)
    set(why "npm could not fetch its packages (${failed})")
  elseif(PROBE)
    # npm takes it for no failure if it cannot fetch what is made for this kind of machine alone.
    execute_process(COMMAND ${NODE} -e "${PROBE}" WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE failed)
    if(failed)
      set(why "what npm fetched does not run here")
    endif()
  endif()
endif()
if(NOT why)
  return()
endif()

file(REMOVE_RECURSE ${FOLDER}/node_modules)
file(WRITE ${FOLDER}/without.txt "WITHOUT ${WITHOUT}: ${why}; the next build tries again\n")
string(REPEAT "*" 100 stars)
message("${stars}\nleafhull is built WITHOUT ${WITHOUT}:\n${why}.\nThe next build tries again.\n${stars}")
