// The report's sections, in reading order: what each says, how to read it, and its tables and figures.
#pragma once

#include <vector>

#include "reports/document.h"
#include "reports/figures.h"

namespace sluice {

/// Findings in words and numbers, all computed from the runs.
std::vector<std::string> findings(const ReportData& data);
std::vector<KeyNumber> key_numbers(const ReportData& data);

/// `snapshots` false: no particle pictures.
std::vector<ReportSection> report_sections(const FigureMaker& maker, bool snapshots);

}  // namespace sluice
