# Writes OUTPUT: `extern const std::string_view leafhull::SYMBOL` holding SOURCE. In OpenCL C the
# lines #include "x.clh" are replaced by the file.
cmake_minimum_required(VERSION 3.22)
if(SOURCE MATCHES "\\.cl$")
  get_filename_component(folder ${SOURCE} DIRECTORY)
  file(READ ${SOURCE} text)
  while(text MATCHES "#include \"([^\"]+)\"")
    file(READ ${folder}/${CMAKE_MATCH_1} header)
    string(REPLACE "#include \"${CMAKE_MATCH_1}\"" "${header}" text "${text}")
  endwhile()
  string(HEX "${text}" hex)
else()
  file(READ ${SOURCE} hex HEX)
endif()
# An array of bytes, unlike a literal, has no delimiter that may clash and no limit on its length.
string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${hex}")
get_filename_component(out_folder ${OUTPUT} DIRECTORY)
file(MAKE_DIRECTORY ${out_folder})
file(WRITE ${OUTPUT} "#include <string_view>
namespace leafhull {
static const char bytes[] = {${bytes}'\\0'};
extern const std::string_view ${SYMBOL};
const std::string_view ${SYMBOL}{bytes, sizeof bytes - 1};
}  // namespace leafhull
")
