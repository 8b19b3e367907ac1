#include "validation/fuzz.h"
#include "validation/series.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sluice;
  fuzz::expect_clear_error("runs/x/probes.csv",
                           [&] { fuzz::expect_clean(parse_probes(fuzz::text_of(data, size), "runs/x/probes.csv")); });
  return 0;
}
