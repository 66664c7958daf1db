#include "document.h"

namespace mspskel::experiments {
namespace {

constexpr const char* kStyle =
    "body{font:15px/1.5 sans-serif;max-width:1340px;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;margin:1em 0}td,th{padding:.2em .7em;border-bottom:1px solid #ddd;"
    "text-align:right}td:first-child,th:first-child{text-align:left}img{max-width:100%;display:block}"
    "figure{margin:1em 0}figcaption{color:#555;font-size:13px}";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (c == '"') {
      result += "&quot;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string html_row(const std::vector<std::string>& cells, const std::string& tag) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) row += "<" + tag + ">" + escaped(cell) + "</" + tag + ">";
  return row + "</tr>\n";
}

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += " " + cell + " |";
  return row + "\n";
}

}  // namespace

Document::Document(const std::string& title) : title_(title), markdown_("# " + title + "\n") {}

void Document::heading(const std::string& text) {
  html_ += "<h2>" + escaped(text) + "</h2>\n";
  markdown_ += "\n## " + text + "\n";
}

void Document::paragraph(const std::string& text) {
  html_ += "<p>" + escaped(text) + "</p>\n";
  markdown_ += "\n" + text + "\n";
}

void Document::table(const Table& table) {
  html_ += "<table>\n" + html_row(table.header, "th");
  for (const auto& row : table.rows) html_ += html_row(row, "td");
  html_ += "</table>\n";
  markdown_ += "\n" + markdown_row(table.header) + "|---|";
  for (std::size_t i = 1; i < table.header.size(); ++i) markdown_ += "---:|";
  markdown_ += "\n";
  for (const auto& row : table.rows) markdown_ += markdown_row(row);
}

void Document::figure(const std::string& file, const std::string& caption) {
  html_ += "<figure><img src=\"" + escaped(file) + "\" alt=\"" + escaped(caption) + "\"><figcaption>" +
           escaped(caption) + "</figcaption></figure>\n";
  markdown_ += "\n![" + caption + "](" + file + ")\n";
}

std::string Document::html() const {
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + escaped(title_) +
         "</title><style>" + kStyle + "</style></head><body>\n<h1>" + escaped(title_) + "</h1>\n" + html_ +
         "</body></html>\n";
}

}  // namespace mspskel::experiments
