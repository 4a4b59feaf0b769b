# The programs that read our files in tests: `cmake --build BUILD --target test_packages` installs the
# packages of package.json from npm. A test that needs a missing one says so and is skipped.
set(LEAFHULL_TEST_PACKAGES ${PROJECT_BINARY_DIR}/test-packages)
leafhull_npm_packages(${LEAFHULL_TEST_PACKAGES} ${CMAKE_CURRENT_SOURCE_DIR}
  "the tests in a browser, of tilesets and by the Khronos validator, which are skipped")
add_custom_target(test_packages DEPENDS ${LEAFHULL_TEST_PACKAGES}/node_modules/.package-lock.json)

find_program(LEAFHULL_CHROMIUM NAMES chromium chromium-browser google-chrome)
mark_as_advanced(LEAFHULL_CHROMIUM)

set(LEAFHULL_TEST_NODE "${LEAFHULL_NODE}")
if(LEAFHULL_NO_NPM)
  set(LEAFHULL_TEST_NODE "")
endif()

# leafhull_node_test(NAME SCRIPT FIXTURE ENVIRONMENT...): a test that node runs; it exits with 77 if
# something it needs is missing.
function(leafhull_node_test name script fixture)
  if(LEAFHULL_NO_NPM)
    add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -E echo "SKIPPED: ${LEAFHULL_NO_NPM}")
    set_tests_properties(${name} PROPERTIES SKIP_REGULAR_EXPRESSION "^SKIPPED")
  else()
    add_test(NAME ${name} COMMAND ${LEAFHULL_NODE} ${script})
  endif()
  set_tests_properties(${name} PROPERTIES
    FIXTURES_REQUIRED ${fixture} SKIP_RETURN_CODE 77 TIMEOUT 600
    ENVIRONMENT "PACKAGES=${LEAFHULL_TEST_PACKAGES};WEB=${PROJECT_BINARY_DIR}/web;CHROMIUM=${LEAFHULL_CHROMIUM};${ARGN}")
endfunction()

# check_with_validator(TARGET): tells a test program where the validator is (unit/khronos_validator.h).
function(check_with_validator target)
  if(TARGET ${target})
    target_compile_definitions(${target} PRIVATE
      LEAFHULL_NODE="${LEAFHULL_TEST_NODE}"
      LEAFHULL_VALIDATE_GLB="${CMAKE_CURRENT_SOURCE_DIR}/cli/validate_glb.mjs"
      LEAFHULL_VALIDATOR="${LEAFHULL_TEST_PACKAGES}")
  endif()
endfunction()
