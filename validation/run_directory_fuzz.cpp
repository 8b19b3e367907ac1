#include "validation/fuzz.h"
#include "validation/run_directory.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sluice;
  fuzz::expect_clear_error("runs/x/run.json", [&] {
    const RunRecord run = parse_run(fuzz::text_of(data, size), "runs/x");
    for (const char* key : {"particles.fluid", "lost.through_walls", "phases", "alpha", "wall_time_s"}) {
      run.number(key);
      run.text(key);
    }
    if (run.label().empty() || run.status().size() > size) std::abort();
  });
  return 0;
}
