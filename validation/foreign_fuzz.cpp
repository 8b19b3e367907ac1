#include "validation/foreign.h"
#include "validation/fuzz.h"

// The input is a map and, behind lines of "====", the files that it names.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sluice;
  const auto texts = fuzz::split_files(fuzz::text_of(data, size));
  fuzz::expect_clear_error("x/", [&] {
    const ForeignMap map = parse_foreign_map(texts.front(), "x/map.toml");
    if (map.files.size() != texts.size() - 1) return;
    const ProbeTable table = parse_foreign(map, std::span(texts).subspan(1));
    if (table.rows() == 0) std::abort();
    fuzz::expect_clean(table);
  });
  return 0;
}
