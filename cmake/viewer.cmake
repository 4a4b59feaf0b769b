# The script that turns the shapes of a report: web/, bundled at build time by esbuild, which npm
# fetches with three.js. LEAFHULL_VIEWER is the bundle; it is empty without LEAFHULL_BUILD_VIEWER or
# without the npm packages.
set(LEAFHULL_WEB ${PROJECT_BINARY_DIR}/web)
set(LEAFHULL_VIEWER ${LEAFHULL_WEB}/viewer.bundle.js)
file(MAKE_DIRECTORY ${LEAFHULL_WEB})
if(NOT LEAFHULL_BUILD_VIEWER)
  file(WRITE ${LEAFHULL_WEB}/none.js "")
  set(LEAFHULL_VIEWER ${LEAFHULL_WEB}/none.js)
  message(STATUS "viewer: none, reports show still pictures (LEAFHULL_BUILD_VIEWER is off)")
  return()
endif()

leafhull_npm_packages(${LEAFHULL_WEB} ${PROJECT_SOURCE_DIR}/web
  "the turning shapes of reports, which have still pictures alone" "require('esbuild').transformSync('')")
set(script ${PROJECT_SOURCE_DIR}/cmake/bundle_viewer.cmake)
set(sources build.mjs package-lock.json package.json viewer.js)
list(TRANSFORM sources PREPEND ${PROJECT_SOURCE_DIR}/web/)
add_custom_command(OUTPUT ${LEAFHULL_VIEWER}
  COMMAND ${CMAKE_COMMAND} -DNODE=${LEAFHULL_NODE} -DFROM=${PROJECT_SOURCE_DIR}/web -DFOLDER=${LEAFHULL_WEB}
          -DBUNDLE=${LEAFHULL_VIEWER} -P ${script}
  DEPENDS ${sources} ${script} ${LEAFHULL_WEB}/node_modules/.package-lock.json
  COMMENT "Bundling the viewer" VERBATIM)
