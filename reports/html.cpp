#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <kainjow/mustache.hpp>
#include <sstream>
#include <stdexcept>

#include "reports/document.h"
#include "reports/templates.h"
#include "reports/text.h"

namespace sluice {

namespace {

std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot read this picture of the report", file.string()));
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

std::string base64(const std::string& bytes) {
  static constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? alphabet[group >> (18 - 6 * k) & 63u] : '=';
  }
  return out;
}

struct HtmlBlock {
  const std::filesystem::path& folder;

  std::string operator()(const Paragraph& p) const {
    return fmt::format("<p{}>{}</p>\n", p.hint ? " class=\"hint\"" : "", inline_html(p.text));
  }
  std::string operator()(const BulletList& list) const {
    std::string out = "<ul>\n";
    for (const std::string& item : list.items) out += fmt::format("<li>{}</li>\n", inline_html(item));
    return out + "</ul>\n";
  }
  std::string operator()(const Table& table) const { return to_html(table); }
  std::string operator()(const Picture& picture) const {
    const std::string bytes = read_bytes(folder / picture.file);
    const std::string drawing = picture.file.extension() == ".svg"
                                    ? svg_for_page(bytes, slug(picture.name), picture.description)
                                    : fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">",
                                                  escape_html(picture.description), base64(bytes));
    return fmt::format(
        "<figure class=\"picture{}\" id=\"{}\"><div class=\"frame\" tabindex=\"0\">{}</div>"
        "<figcaption>{}</figcaption></figure>\n",
        picture.wide ? " wide" : "", slug(picture.name), drawing, inline_html(picture.caption));
  }
};

/// Pictures that follow each other share a grid, so that they stand side by side where there is room.
std::string section_body(const ReportSection& section, const std::filesystem::path& folder) {
  std::string out;
  bool in_grid = false;
  for (const Block& block : section.blocks) {
    const bool picture = std::holds_alternative<Picture>(block);
    if (picture != in_grid) out += picture ? "<div class=\"pictures\">\n" : "</div>\n";
    in_grid = picture;
    out += std::visit(HtmlBlock{folder}, block);
  }
  return out + (in_grid ? "</div>\n" : "");
}

}  // namespace

namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// Removes `name="value"` from an element's head.
void remove_attribute(std::string& head, std::string_view name) {
  const std::size_t start = head.find(fmt::format(" {}=", name));
  if (start == std::string::npos) return;
  const std::size_t open = start + name.size() + 2;
  const std::size_t close = head.find(head.at(open), open + 1);
  if (close != std::string::npos) head.erase(start, close + 1 - start);
}

/// Tool tips that name gnuplot's internal counters help nobody.
void remove_titles(std::string& svg) {
  for (std::size_t at = svg.find("<title>"); at != std::string::npos; at = svg.find("<title>", at)) {
    const std::size_t close = svg.find("</title>", at);
    if (close == std::string::npos) return;
    svg.erase(at, close + 8 - at);
  }
}

/// Panels of one drawing repeat gnuplot's names of their curves, to which nothing refers.
void remove_curve_names(std::string& svg) {
  constexpr std::string_view mark = " id=\"gnuplot_";
  for (std::size_t at = svg.find(mark); at != std::string::npos; at = svg.find(mark, at)) {
    const std::size_t close = svg.find('"', at + mark.size());
    if (close == std::string::npos) return;
    svg.erase(at, close + 1 - at);
  }
}

}  // namespace

std::string svg_for_page(std::string svg, const std::string& prefix, const std::string& description) {
  const std::size_t start = svg.find("<svg");
  if (start == std::string::npos) throw std::runtime_error(fmt::format("figure {}: not an SVG drawing", prefix));
  svg.erase(0, start);
  remove_titles(svg);
  remove_curve_names(svg);
  replace_all(svg, "xlink:href=", "href=");
  for (const char quote : {'"', '\''}) {
    replace_all(svg, fmt::format(" id={}", quote), fmt::format(" id={}{}-", quote, prefix));
    replace_all(svg, fmt::format("href={}#", quote), fmt::format("href={}#{}-", quote, prefix));
  }
  replace_all(svg, "url(#", fmt::format("url(#{}-", prefix));
  const std::size_t end = svg.find('>');
  std::string head = svg.substr(0, end);
  std::replace(head.begin(), head.end(), '\n', ' ');
  for (const char* name : {"width", "height", "xmlns:xlink", "xmlns"}) remove_attribute(head, name);
  return fmt::format("{} role=\"img\" aria-label=\"{}\"{}", head, escape_html(description), svg.substr(end));
}

std::string to_html(const ReportDocument& document, const std::filesystem::path& folder) {
  namespace mustache = kainjow::mustache;
  mustache::data sections(mustache::data::type::list);
  for (const ReportSection& section : document.sections) {
    mustache::data entry;
    entry.set("id", section.id);
    entry.set("title", section.title);
    entry.set("body", section_body(section, folder));
    sections.push_back(entry);
  }
  mustache::data keys(mustache::data::type::list);
  for (const KeyNumber& key : document.key_numbers) {
    mustache::data entry;
    entry.set("label", key.label);
    entry.set("value", key.value);
    entry.set("remark", key.remark);
    keys.push_back(entry);
  }
  mustache::data page;
  page.set("title", document.title);
  page.set("subtitle", inline_html(document.subtitle));
  page.set("made", inline_html(document.made));
  page.set("style", std::string(page_style));
  page.set("has_keys", !document.key_numbers.empty());
  page.set("keys", keys);
  page.set("sections", sections);
  mustache::mustache view{std::string(page_template)};
  if (!view.is_valid())
    throw std::runtime_error("report: reports/templates/page.mustache is broken: " + view.error_message());
  return view.render(page);
}

}  // namespace sluice
