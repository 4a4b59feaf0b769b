# cmake -P: bundles the viewer FROM web/ into BUNDLE with the packages in FOLDER. If they are missing,
# BUNDLE is empty (npm_packages.cmake has said why).
if(EXISTS ${FOLDER}/node_modules/.package-lock.json)
  file(COPY ${FROM}/build.mjs ${FROM}/viewer.js ${FROM}/package.json DESTINATION ${FOLDER})
  execute_process(COMMAND ${NODE} build.mjs ${BUNDLE} WORKING_DIRECTORY ${FOLDER} COMMAND_ERROR_IS_FATAL ANY)
else()
  file(CONFIGURE OUTPUT ${BUNDLE} CONTENT "")  # leaves an empty file untouched
endif()
