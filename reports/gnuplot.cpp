#include "reports/gnuplot.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "validation/printable.h"

namespace sluice {

namespace {}  // namespace

void run_gnuplot(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& scripts) {
  std::string command = fmt::format("cd {} && gnuplot", shell_quoted(folder.string()));
  for (const auto& script : scripts) command.append(" ").append(shell_quoted(script.string()));
  std::FILE* pipe = popen(command.append(" 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("report: cannot start a shell to run gnuplot");
  std::string said;
  std::array<char, 512> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) said += buffer.data();
  const int state = pclose(pipe);
  const int code = WIFEXITED(state) ? WEXITSTATUS(state) : -1;
  if (code == 127)
    throw std::runtime_error(
        "report: gnuplot, which draws the figures, is not installed (remedy: apt-get install gnuplot-nox, or leave the "
        "figures out)");
  if (code != 0)
    throw std::runtime_error(
        fmt::format("{}: gnuplot failed on {}: {}", folder.string(), scripts.front().string(), said));
}

}  // namespace sluice
