#pragma once

#include <pugixml.hpp>
#include <string_view>

namespace mspskel::detail {

// Throws ReadError with the byte that is wrong. Memory: some thirty times the text at worst; entities that a
// document declares itself are not expanded.
void load_xml(std::string_view text, pugi::xml_document& document);

// The name without its namespace's prefix.
std::string_view local_name(const pugi::xml_node& node);

// The next element of that name among the node and its siblings after it, or none.
pugi::xml_node element_from(pugi::xml_node node, std::string_view name);
inline pugi::xml_node first_element(const pugi::xml_node& parent, std::string_view name) {
  return element_from(parent.first_child(), name);
}
inline pugi::xml_node next_element(const pugi::xml_node& node, std::string_view name) {
  return element_from(node.next_sibling(), name);
}

}  // namespace mspskel::detail
