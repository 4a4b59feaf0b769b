# What `cmake --install` installs, and where. A consumer sees the public headers and one library and
# needs no third-party packages.
set(leafhull_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/leafhull)

set(RENDER_HEADERS picture render)
set(STUDY_HEADERS study sweep)
set(FOREST_HEADERS forest ranks scene)
foreach(part RENDER STUDY FOREST)
  if(NOT LEAFHULL_${part})
    foreach(header IN LISTS ${part}_HEADERS)
      list(APPEND left_out PATTERN ${header}.h EXCLUDE)
    endforeach()
  endif()
endforeach()
install(DIRECTORY include/leafhull ${PROJECT_BINARY_DIR}/include/leafhull
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h" ${left_out})
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

# The manual and the shell completions, as the command prints them. A command that is built for another
# machine or with sanitizers is not run here.
if(NOT CMAKE_CROSSCOMPILING AND NOT "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_RELWITHDEBINFO}" MATCHES "-fsanitize")
  # leafhull_printed(FILE FOLDER WORD...): installs the output of `leafhull WORD...` as FOLDER/FILE.
  function(leafhull_printed file folder)
    set(output ${PROJECT_BINARY_DIR}/printed/${file})
    add_custom_command(OUTPUT ${output} DEPENDS leafhull_command VERBATIM
      COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/printed
      COMMAND leafhull_command ${ARGN} > ${output})
    add_custom_target(print_${file} ALL DEPENDS ${output})
    install(FILES ${output} DESTINATION ${folder} OPTIONAL)  # missing after a build of single targets
  endfunction()
  leafhull_printed(leafhull.1 ${CMAKE_INSTALL_MANDIR}/man1 help-manual)
  leafhull_printed(leafhull ${CMAKE_INSTALL_DATADIR}/bash-completion/completions completion bash)
  leafhull_printed(_leafhull ${CMAKE_INSTALL_DATADIR}/zsh/site-functions completion zsh)
  leafhull_printed(leafhull.fish ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d completion fish)
endif()
