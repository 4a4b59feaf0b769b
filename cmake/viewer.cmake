# The script that turns the shapes of a report: web/, bundled at build time by esbuild, which npm
# brings with three.js. LEAFHULL_VIEWER is the bundle; without LEAFHULL_BUILD_VIEWER it is empty.
set(LEAFHULL_WEB ${PROJECT_BINARY_DIR}/web)
set(LEAFHULL_VIEWER ${LEAFHULL_WEB}/viewer.bundle.js)
file(MAKE_DIRECTORY ${LEAFHULL_WEB})
if(NOT LEAFHULL_BUILD_VIEWER)
  file(WRITE ${LEAFHULL_WEB}/none.js "")
  set(LEAFHULL_VIEWER ${LEAFHULL_WEB}/none.js)
  message(STATUS "viewer: none, reports show still pictures (LEAFHULL_BUILD_VIEWER is off)")
  return()
endif()

find_program(LEAFHULL_NODE NAMES node nodejs)
find_program(LEAFHULL_NPM npm)
mark_as_advanced(LEAFHULL_NODE LEAFHULL_NPM)
if(LEAFHULL_NODE)
  execute_process(COMMAND ${LEAFHULL_NODE} --version OUTPUT_VARIABLE node_version
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REPLACE "v" "" node_version "${node_version}")
endif()
if(NOT LEAFHULL_NPM OR NOT node_version VERSION_GREATER_EQUAL 18)
  message(FATAL_ERROR "leafhull's reports need npm and node 18 or newer to be built, found '${LEAFHULL_NPM}' "
                      "and node '${node_version}'. On Debian: apt-get install nodejs npm. "
                      "Or leave the turning shapes out: -DLEAFHULL_BUILD_VIEWER=OFF")
endif()
message(STATUS "node ${node_version}")

set(sources build.mjs package-lock.json package.json viewer.js)
list(TRANSFORM sources PREPEND ${PROJECT_SOURCE_DIR}/web/)
set(installed ${LEAFHULL_WEB}/node_modules/.package-lock.json)
add_custom_command(OUTPUT ${installed}
  COMMAND ${CMAKE_COMMAND} -E copy ${PROJECT_SOURCE_DIR}/web/package.json
          ${PROJECT_SOURCE_DIR}/web/package-lock.json ${LEAFHULL_WEB}
  COMMAND ${LEAFHULL_NPM} ci --no-audit --no-fund --ignore-scripts $<$<NOT:$<BOOL:${BUILD_TESTING}>>:--omit=dev>
  WORKING_DIRECTORY ${LEAFHULL_WEB}
  DEPENDS ${PROJECT_SOURCE_DIR}/web/package.json ${PROJECT_SOURCE_DIR}/web/package-lock.json
  COMMENT "Fetching three.js and esbuild" COMMAND_EXPAND_LISTS VERBATIM)
add_custom_command(OUTPUT ${LEAFHULL_VIEWER}
  COMMAND ${CMAKE_COMMAND} -E copy ${sources} ${LEAFHULL_WEB}
  COMMAND ${LEAFHULL_NODE} build.mjs ${LEAFHULL_VIEWER}
  WORKING_DIRECTORY ${LEAFHULL_WEB}
  DEPENDS ${sources} ${installed}
  COMMENT "Bundling the viewer" VERBATIM)
