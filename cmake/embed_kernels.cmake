# leafhull_embed_kernels(TARGET FILE...): compiles OpenCL sources into TARGET as raw bytes, their
# #include "x.clh" lines replaced by the file. See embed_kernel.cmake for the generated code.
function(leafhull_embed_kernels target)
  file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/kernels/*.clh)
  foreach(source IN LISTS ARGN)
    get_filename_component(name ${source} NAME_WE)
    set(generated ${CMAKE_CURRENT_BINARY_DIR}/kernels/${name}.cpp)
    add_custom_command(
      OUTPUT ${generated}
      COMMAND ${CMAKE_COMMAND} -DSOURCE=${source} -DOUTPUT=${generated} -DNAME=${name}
              -P ${PROJECT_SOURCE_DIR}/cmake/embed_kernel.cmake
      DEPENDS ${source} ${headers} ${PROJECT_SOURCE_DIR}/cmake/embed_kernel.cmake
      COMMENT "Embedding ${name}.cl" VERBATIM)
    target_sources(${target} PRIVATE ${generated})
  endforeach()
endfunction()

# leafhull_embed_file(TARGET NAME FILE): compiles a file's bytes into TARGET as `NAME`.
function(leafhull_embed_file target name file)
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  add_custom_command(
    OUTPUT ${generated}
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${file} -DOUTPUT=${generated} -DNAME=${name}
            -P ${PROJECT_SOURCE_DIR}/cmake/embed_file.cmake
    DEPENDS ${file} ${PROJECT_SOURCE_DIR}/cmake/embed_file.cmake
    COMMENT "Embedding ${file}" VERBATIM)
  target_sources(${target} PRIVATE ${generated})
endfunction()
