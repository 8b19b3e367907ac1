#include <fmt/format.h>

#include "reports/document.h"
#include "reports/text.h"

namespace sluice {

namespace {

struct MarkdownBlock {
  std::string operator()(const Paragraph& p) const { return p.hint ? "> " + p.text : p.text; }
  std::string operator()(const BulletList& list) const {
    std::string out;
    for (const std::string& item : list.items) out += (out.empty() ? "- " : "\n- ") + item;
    return out;
  }
  std::string operator()(const Table& table) const {
    return fmt::format("{}\nAs data: [CSV](tables/{}.csv), [LaTeX](tables/{}.tex).", to_markdown(table), table.name,
                       table.name);
  }
  std::string operator()(const Picture& picture) const {
    return fmt::format("![{}]({})\n\n*{}*", picture.description, picture.file.generic_string(), picture.caption);
  }
};

}  // namespace

std::string to_markdown(const ReportDocument& document) {
  std::string out = fmt::format("# {}\n\n{}\n\n{}\n", document.title, document.subtitle, document.made);
  if (!document.key_numbers.empty()) {
    out += "\n| | | |\n|---|---:|---|\n";
    for (const KeyNumber& key : document.key_numbers)
      out += fmt::format("| {} | **{}** | {} |\n", escape_markdown_cell(key.label), escape_markdown_cell(key.value),
                         escape_markdown_cell(key.remark));
  }
  for (const ReportSection& section : document.sections) {
    out += fmt::format("\n<a id=\"{}\"></a>\n\n## {}\n", section.id, section.title);
    for (const Block& block : section.blocks) out += fmt::format("\n{}\n", std::visit(MarkdownBlock{}, block));
  }
  return out;
}

}  // namespace sluice
