# cmake -P: installs the packages of LISTS/package-lock.json in FOLDER with NPM, unless NO_NPM says why
# not. NODE must then be able to run the script PROBE there. If any of this fails, FOLDER has no
# node_modules, FOLDER/without.txt says why and what is missing (WITHOUT), and the build continues.
file(REMOVE_RECURSE ${FOLDER}/node_modules ${FOLDER}/without.txt)  # a partial set must not look complete
set(why "${NO_NPM}")
if(NOT why)
  file(COPY ${LISTS}/package.json ${LISTS}/package-lock.json DESTINATION ${FOLDER})
  # By default npm waits minutes before it gives up, one package after another. One query about a package
  # with few versions shows whether the registry can be reached or npm must use its cache.
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
    # npm does not fail if it cannot fetch a package that is specific to this kind of machine.
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
