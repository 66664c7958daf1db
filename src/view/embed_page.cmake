# cmake -DPAGE=page.html -DOUTPUT=page_template.cpp -P embed_page.cmake: a source file that holds the page's bytes.
file(READ "${PAGE}" bytes HEX)
string(REGEX REPLACE "(................................................................)" "\\1\n" bytes "${bytes}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
file(WRITE "${OUTPUT}" "#include \"page_template.h\"

namespace mspskel::detail {
namespace {

constexpr unsigned char kPage[] = {
${bytes}
};

}  // namespace

std::string_view page_template() { return {reinterpret_cast<const char*>(kPage), sizeof kPage}; }

}  // namespace mspskel::detail
")
