# The Khronos glTF validator: `cmake --build BUILD --target gltf_validator` installs it there.
set(LEAFHULL_VALIDATOR ${PROJECT_BINARY_DIR}/gltf-validator)
find_program(NODE NAMES node nodejs)
find_program(NPM npm)
if(NODE AND NPM)
  set(packages ${CMAKE_CURRENT_SOURCE_DIR}/cli/package.json ${CMAKE_CURRENT_SOURCE_DIR}/cli/package-lock.json)
  add_custom_command(OUTPUT ${LEAFHULL_VALIDATOR}/node_modules/.package-lock.json
    COMMAND ${CMAKE_COMMAND} -E make_directory ${LEAFHULL_VALIDATOR}
    COMMAND ${CMAKE_COMMAND} -E copy ${packages} ${LEAFHULL_VALIDATOR}
    COMMAND ${NPM} ci --prefix ${LEAFHULL_VALIDATOR} --no-audit --no-fund --ignore-scripts
    DEPENDS ${packages} VERBATIM)
  add_custom_target(gltf_validator DEPENDS ${LEAFHULL_VALIDATOR}/node_modules/.package-lock.json)
endif()

# check_with_validator(TARGET): says to a test program where it is (unit/khronos_validator.h).
function(check_with_validator target)
  if(TARGET ${target})
    target_compile_definitions(${target} PRIVATE
      LEAFHULL_NODE="${NODE}"
      LEAFHULL_VALIDATE_GLB="${CMAKE_CURRENT_SOURCE_DIR}/cli/validate_glb.mjs"
      LEAFHULL_VALIDATOR="${LEAFHULL_VALIDATOR}")
  endif()
endfunction()
