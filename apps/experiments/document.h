// A page of headings, paragraphs, tables and figures, as HTML and as Markdown.
#pragma once

#include <string>
#include <vector>

namespace mspskel::experiments {

struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  // as wide as the header
};

class Document {
 public:
  explicit Document(const std::string& title);

  void heading(const std::string& text);
  void paragraph(const std::string& text);
  void table(const Table& table);
  // A picture file beside the page.
  void figure(const std::string& file, const std::string& caption);

  std::string html() const;
  std::string markdown() const { return markdown_; }

 private:
  std::string title_, html_, markdown_;
};

}  // namespace mspskel::experiments
