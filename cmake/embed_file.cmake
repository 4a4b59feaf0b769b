# Writes OUTPUT: `extern const std::string_view leafhull::NAME` holding the bytes of SOURCE.
cmake_minimum_required(VERSION 3.22)
file(READ ${SOURCE} hex HEX)
string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${hex}")
file(WRITE ${OUTPUT} "#include <string_view>
namespace leafhull {
static const char bytes[] = {${bytes}'\\0'};
extern const std::string_view ${NAME};
const std::string_view ${NAME}{bytes, sizeof bytes - 1};
}  // namespace leafhull
")
