#include "validation/digest.h"
#include "validation/fuzz.h"
#include "validation/measured.h"

// The input is a source.toml and, behind lines of "====", the raw files that it describes, called x/... there. What
// comes out must be a digest that can be read.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sluice;
  const auto texts = fuzz::split_files(fuzz::text_of(data, size));
  std::string made;
  fuzz::expect_clear_error("x/", [&] {
    DigestSource source = parse_digest_source(texts.front(), "x/source.toml");
    if (source.files.size() != texts.size() - 1) return;
    for (RawFile& file : source.files) file.file = "x/raw.dat";
    made = digest_of(source, std::span(texts).subspan(1));
  });
  if (!made.empty()) MeasuredData::parse(made, "x/digest.csv");
  return 0;
}
