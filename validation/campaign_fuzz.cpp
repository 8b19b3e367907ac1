#include "validation/campaign.h"
#include "validation/fuzz.h"

// Cases are found beside the campaign's file: those of the corpus of case_fuzz.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sluice;
  const std::string file = "validation/corpora/case/x.toml";
  fuzz::expect_clear_error("validation/corpora/case/",
                           [&] { parse_campaign(fuzz::text_of(data, size), file, "runs", 1); });
  return 0;
}
