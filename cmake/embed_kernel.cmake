# Writes OUTPUT: `extern const std::string_view leafhull::kernel_source_NAME` holding SOURCE.
cmake_minimum_required(VERSION 3.22)
get_filename_component(folder ${SOURCE} DIRECTORY)
file(READ ${SOURCE} text)
while(text MATCHES "#include \"([^\"]+)\"")
  file(READ ${folder}/${CMAKE_MATCH_1} header)
  string(REPLACE "#include \"${CMAKE_MATCH_1}\"" "${header}" text "${text}")
endwhile()
# Bytes rather than a literal: no delimiter to clash with, no limit on length.
string(HEX "${text}" hex)
string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${hex}")
get_filename_component(out_folder ${OUTPUT} DIRECTORY)
file(MAKE_DIRECTORY ${out_folder})
file(WRITE ${OUTPUT} "#include <string_view>
namespace leafhull {
static const char bytes[] = {${bytes}'\\0'};
extern const std::string_view kernel_source_${NAME};
const std::string_view kernel_source_${NAME}{bytes, sizeof bytes - 1};
}  // namespace leafhull
")
