# Mustache templates, one header. Defines kainjow_mustache_FOUND, its version and kainjow::mustache.
include(FindPackageHandleStandardArgs)
find_path(kainjow_mustache_INCLUDE_DIR kainjow/mustache.hpp)
mark_as_advanced(kainjow_mustache_INCLUDE_DIR)
if(kainjow_mustache_INCLUDE_DIR)
  file(STRINGS ${kainjow_mustache_INCLUDE_DIR}/kainjow/mustache.hpp line REGEX "Mustache v[0-9.]+" LIMIT_COUNT 1)
  string(REGEX MATCH "[0-9.]+" kainjow_mustache_VERSION "${line}")
endif()
find_package_handle_standard_args(kainjow_mustache REQUIRED_VARS kainjow_mustache_INCLUDE_DIR
                                  VERSION_VAR kainjow_mustache_VERSION)
if(kainjow_mustache_FOUND AND NOT TARGET kainjow::mustache)
  add_library(kainjow::mustache INTERFACE IMPORTED)
  set_target_properties(kainjow::mustache PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES ${kainjow_mustache_INCLUDE_DIR})
endif()
