include(${CMAKE_CURRENT_LIST_DIR}/leafhullTargets.cmake)
