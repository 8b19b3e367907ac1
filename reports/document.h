// A report as sections of paragraphs, tables and pictures, before it is turned into Markdown or HTML.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "reports/table.h"

namespace sluice {

/// Text with `code`, **strong** and [words](#section-id).
struct Paragraph {
  std::string text;
  bool hint = false;  ///< "how to read this", set apart from findings
};

struct BulletList {
  std::vector<std::string> items;
};

/// A picture that lies in the report's folder.
struct Picture {
  std::string name;  ///< file stem in figures/, also the anchor
  std::string caption;
  std::string description;     ///< for those who cannot see it
  std::filesystem::path file;  ///< .svg or .png, relative to the report's folder
  bool wide = false;           ///< takes the page's full width instead of half of it
};

using Block = std::variant<Paragraph, BulletList, Table, Picture>;

struct ReportSection {
  std::string id;
  std::string title;
  std::vector<Block> blocks;
};

/// One figure of the head: what a reader should see first.
struct KeyNumber {
  std::string label;
  std::string value;
  std::string remark;
};

struct ReportDocument {
  std::string title;
  std::string subtitle;
  std::string made;  ///< when, by which version
  std::vector<KeyNumber> key_numbers;
  std::vector<ReportSection> sections;
};

std::string to_markdown(const ReportDocument& document);

/// One page that needs nothing but itself: style and pictures stand in it. `folder` is where the pictures lie.
/// Throws std::runtime_error naming a picture that cannot be read.
std::string to_html(const ReportDocument& document, const std::filesystem::path& folder);

/// Makes an SVG drawing fit to stand inside a page beside others: no XML head, no fixed size, and every identifier
/// prefixed, so that two drawings do not share one.
std::string svg_for_page(std::string svg, const std::string& prefix, const std::string& description);

}  // namespace sluice
