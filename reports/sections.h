// The report's sections, in reading order: what each says, how to read it, and its tables and figures.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reports/document.h"
#include "reports/figures.h"

namespace sluice {

/// Findings in words and numbers, all computed from the runs.
std::vector<std::string> findings(const ReportData& data);
std::vector<KeyNumber> key_numbers(const ReportData& data);

/// "How to read this", set apart from findings.
inline Paragraph hint(std::string text) {
  return {std::move(text), true};
}

inline void append(ReportSection& section, const std::vector<Picture>& pictures) {
  for (const Picture& picture : pictures) section.blocks.push_back(picture);
}

/// What the sensors saw, a section for each kind that the case has.
void add_sensor_sections(std::vector<ReportSection>& sections, const FigureMaker& maker);

/// `snapshots` false: no particle pictures.
std::vector<ReportSection> report_sections(const FigureMaker& maker, bool snapshots);

}  // namespace sluice
