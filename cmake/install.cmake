# What `cmake --install` puts where. A consumer sees the public headers and one library; it needs no
# third-party package of its own.
set(leafhull_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/leafhull)

install(DIRECTORY include/leafhull ${PROJECT_BINARY_DIR}/include/leafhull
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(TARGETS leafhull EXPORT leafhullTargets)
install(EXPORT leafhullTargets NAMESPACE leafhull:: DESTINATION ${leafhull_cmake_dir})
install(FILES LICENSE NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})

file(RELATIVE_PATH bin_to_lib ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
set_target_properties(leafhull_command PROPERTIES INSTALL_RPATH "$ORIGIN/${bin_to_lib}")
install(TARGETS leafhull_command)

include(CMakePackageConfigHelpers)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/leafhullConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES cmake/leafhullConfig.cmake ${PROJECT_BINARY_DIR}/leafhullConfigVersion.cmake
        DESTINATION ${leafhull_cmake_dir})
