// The dashboard's page, from ci/page/.
#pragma once

namespace sluice::ci {

extern const char* const page_html;
extern const char* const page_style;
extern const char* const page_script;

}  // namespace sluice::ci
