# npm packages, for what Debian does not have. If node, npm or the registry is missing, the build says
# so and continues without them; the next build tries again.
find_program(LEAFHULL_NODE NAMES node nodejs)
find_program(LEAFHULL_NPM npm)
mark_as_advanced(LEAFHULL_NODE LEAFHULL_NPM)

# Why node or npm cannot be used; empty if they can.
set(LEAFHULL_NO_NPM "")
set(node_version "")
if(LEAFHULL_NODE)
  execute_process(COMMAND ${LEAFHULL_NODE} --version OUTPUT_VARIABLE node_version ERROR_QUIET
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REPLACE "v" "" node_version "${node_version}")
endif()
if(NOT node_version)
  set(LEAFHULL_NO_NPM "there is no node (on Debian: apt-get install nodejs npm)")
elseif(node_version VERSION_LESS 18)
  set(LEAFHULL_NO_NPM "node is ${node_version}, but 18 or newer is needed")
elseif(NOT LEAFHULL_NPM)
  set(LEAFHULL_NO_NPM "there is no npm (on Debian: apt-get install npm)")
else()
  message(STATUS "node ${node_version}")
endif()

# leafhull_npm_packages(FOLDER LISTS WITHOUT [PROBE]): installs the packages of LISTS/package-lock.json in
# FOLDER; see npm_packages.cmake. If that fails, FOLDER/node_modules/.package-lock.json stays missing, so
# the next build runs this again; what depends on that file is built all the same.
function(leafhull_npm_packages folder lists without)
  set(packages ${lists}/package.json ${lists}/package-lock.json)
  set(script ${PROJECT_SOURCE_DIR}/cmake/npm_packages.cmake)
  file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${lists})
  add_custom_command(OUTPUT ${folder}/node_modules/.package-lock.json
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${folder} -DLISTS=${lists} -DWITHOUT=${without} -DPROBE=${ARGN}
            -DNODE=${LEAFHULL_NODE} -DNPM=${LEAFHULL_NPM} -DNO_NPM=${LEAFHULL_NO_NPM} -P ${script}
    DEPENDS ${packages} ${script}
    COMMENT "Fetching the packages of ${name}/package.json" VERBATIM)
endfunction()
