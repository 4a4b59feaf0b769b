# Installs BUILD_DIR into WORK_DIR, builds examples/extract against it and runs it on TREE, then runs
# the installed command, which must find its library by itself.
cmake_minimum_required(VERSION 3.24)

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/../../examples/extract -B ${WORK_DIR}/build -G Ninja
    -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix -DCMAKE_CXX_COMPILER=${CXX_COMPILER})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/extract ${TREE} ${WORK_DIR}/shape.glb)
run(${WORK_DIR}/prefix/bin/leafhull --version)
if(EXISTS ${BUILD_DIR}/printed)  # a build with sanitizers has none
  foreach(file man/man1/leafhull.1 bash-completion/completions/leafhull
          zsh/site-functions/_leafhull fish/vendor_completions.d/leafhull.fish)
    if(NOT EXISTS ${WORK_DIR}/prefix/share/${file})
      message(FATAL_ERROR "share/${file} is not installed")
    endif()
  endforeach()
endif()
