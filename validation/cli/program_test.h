// Programs as their users meet them: exit codes, and what goes to which stream.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace sluice::program_test {

struct Answer {
  int exit_code = 0;  ///< -1: ended by a signal
  std::string out;
  std::string err;
};

inline std::string contents(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// Where a program is: as an environment variable says, or in the release build.
inline std::string program_path(const char* variable, const std::string& name) {
  const char* given = std::getenv(variable);
  return given != nullptr ? given : fmt::format("build/release/{}", name);
}

/// A directory of the test's own, gone when it ends.
class InDirectory : public testing::Test {
 protected:
  explicit InDirectory(const std::string& stem)
      : directory(std::filesystem::temp_directory_path() /
                  fmt::format("{}-{}", stem, testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::remove_all(directory);
    std::filesystem::create_directories(directory);
  }
  ~InDirectory() override { std::filesystem::remove_all(directory); }

  /// A line of the shell.
  Answer command(const std::string& line) const {
    const auto out = directory / "stdout", err = directory / "stderr";
    const int status = std::system(fmt::format("{} >{} 2>{} </dev/null", line, out.string(), err.string()).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(out), contents(err)};
  }

  std::filesystem::path directory;
};

}  // namespace sluice::program_test
