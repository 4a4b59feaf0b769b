# libwebp, whose Debian package has no CMake files. Defines the target WebP::webp; its version is that
# of the decoder's interface.
find_path(WebP_INCLUDE_DIR webp/decode.h)
find_library(WebP_LIBRARY webp)
mark_as_advanced(WebP_INCLUDE_DIR WebP_LIBRARY)
set(WebP_VERSION "")
if(WebP_INCLUDE_DIR)
  file(STRINGS ${WebP_INCLUDE_DIR}/webp/decode.h abi REGEX "define WEBP_DECODER_ABI_VERSION 0x")
  if(abi MATCHES "0x0?([0-9a-f]+)([0-9a-f][0-9a-f])")
    math(EXPR major "0x${CMAKE_MATCH_1}")
    math(EXPR minor "0x${CMAKE_MATCH_2}")
    set(WebP_VERSION ${major}.${minor})
  endif()
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(WebP
  REQUIRED_VARS WebP_LIBRARY WebP_INCLUDE_DIR VERSION_VAR WebP_VERSION)
if(WebP_FOUND AND NOT TARGET WebP::webp)
  add_library(WebP::webp UNKNOWN IMPORTED)
  set_target_properties(WebP::webp PROPERTIES
    IMPORTED_LOCATION ${WebP_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${WebP_INCLUDE_DIR})
endif()
