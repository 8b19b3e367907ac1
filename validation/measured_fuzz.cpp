#include "validation/fuzz.h"
#include "validation/measured.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sluice;
  fuzz::expect_clear_error("data/x/digest.csv", [&] {
    const MeasuredData measured = MeasuredData::parse(fuzz::text_of(data, size), "data/x/digest.csv");
    for (const std::string& name : measured.names())
      if (measured.series(name).maximum.size() != measured.series(name).t_s.size()) std::abort();
  });
  return 0;
}
