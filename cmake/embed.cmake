# leafhull_embed(TARGET SYMBOL FILE [DEPENDS...]): compiles FILE into TARGET as raw bytes, declared as
# `extern const std::string_view leafhull::SYMBOL`. See embed_file.cmake for the generated code.
function(leafhull_embed target symbol file)
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/embedded/${symbol}.cpp)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_file.cmake)
  get_filename_component(name ${file} NAME)
  add_custom_command(
    OUTPUT ${generated}
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${file} -DOUTPUT=${generated} -DSYMBOL=${symbol} -P ${script}
    DEPENDS ${file} ${ARGN} ${script}
    COMMENT "Embedding ${name}" VERBATIM)
  # Each generated file has an array named `bytes`, so they cannot share a unity file.
  set_source_files_properties(${generated} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_sources(${target} PRIVATE ${generated})
endfunction()
