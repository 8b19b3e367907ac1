// The page's template and style, taken into the program when it is built (from reports/templates/).
#pragma once

namespace sluice {

extern const char* const page_template;
extern const char* const page_style;

}  // namespace sluice
