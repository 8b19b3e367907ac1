#include "validation/case.h"
#include "validation/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sluice;
  fuzz::expect_clear_error("x.toml", [&] { parse_case(fuzz::text_of(data, size), "x.toml"); });
  return 0;
}
