#include "xml_document.h"

#include <string>

#include "mspskel/base/error.h"

namespace mspskel::detail {

void load_xml(std::string_view text, pugi::xml_document& document) {
  const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
  if (!result)
    throw ReadError("byte " + std::to_string(result.offset) +
                    ": not well-formed XML: " + result.description());
}

std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

pugi::xml_node element_from(pugi::xml_node node, std::string_view name) {
  while (node && local_name(node) != name) node = node.next_sibling();
  return node;
}

}  // namespace mspskel::detail
