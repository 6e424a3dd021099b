# Writes OUTPUT, a source file that holds the bytes of INPUT, which the function NAME gives.

file(READ "${INPUT}" bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," numbers "${bytes}")
string(REGEX REPLACE "((0x..,){32})" "\\1\n" numbers "${numbers}")
file(
  WRITE "${OUTPUT}"
  "#include <array>\n#include \"PageTemplate.h\"\n\nnamespace allpairs::view {\nnamespace {\n"
  "constexpr unsigned char kPage[] = {\n${numbers}0};\n}  // namespace\n\n"
  "std::string_view ${NAME}() { return {reinterpret_cast<const char*>(kPage), sizeof(kPage) - 1}; }\n\n"
  "}  // namespace allpairs::view\n")
