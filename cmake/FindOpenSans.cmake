# The typeface Open Sans. Defines OpenSans_FOUND and OpenSans_REGULAR, a TrueType file.
include(FindPackageHandleStandardArgs)
find_file(OpenSans_REGULAR OpenSans-Regular.ttf
  PATHS ${CMAKE_PREFIX_PATH} ${CMAKE_SYSTEM_PREFIX_PATH}
  PATH_SUFFIXES share/fonts/truetype/open-sans share/fonts/open-sans)
mark_as_advanced(OpenSans_REGULAR)
find_package_handle_standard_args(OpenSans REQUIRED_VARS OpenSans_REGULAR)
