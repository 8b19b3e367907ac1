// A headless browser for tests, driven by clicks and keys: Chromium through chromedriver's own protocol (W3C
// WebDriver).
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace sluice {

/// Where the two programs are; empty when one is not installed.
struct BrowserPrograms {
  std::string chromium;
  std::string chromedriver;

  bool present() const { return !chromium.empty() && !chromedriver.empty(); }
};
BrowserPrograms find_browser();

/// One window. It can reach no host but this one's files. Every call throws std::runtime_error with the driver's
/// message when it fails, such as when an element is not there or something else covers it.
class Browser {
 public:
  /// `profile`: an empty directory of its own.
  Browser(const BrowserPrograms& programs, const std::filesystem::path& profile);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  void open(const std::filesystem::path& page);
  /// Inner size in CSS pixels.
  void resize(int width, int height);
  /// Clicks in the middle of the first element that fits.
  void click(const std::string& css);
  /// Clicks so many CSS pixels right of and below the middle of the first element that fits.
  void click_beside(const std::string& css, int right, int below);
  void type(const std::string& css, const std::string& keys);
  std::string text(const std::string& css);
  std::size_t count(const std::string& css);
  bool shown(const std::string& css);
  /// Value of a JavaScript function body.
  nlohmann::json evaluate(const std::string& body);
  /// Errors and warnings of the console so far.
  std::vector<std::string> complaints();
  void screenshot(const std::filesystem::path& png);
  /// Lays the page out as for paper ("print") or for the screen ("screen").
  void set_medium(const std::string& medium);
  /// The page as a printer would get it.
  void print(const std::filesystem::path& pdf);

 private:
  nlohmann::json send(const std::string& method, const std::string& path, const nlohmann::json& body = nullptr) const;
  std::string element(const std::string& css) const;

  pid_t driver_ = -1;
  int port_ = 0;
  std::FILE* output_ = nullptr;
  std::string session_;
};

/// Keys that are no characters, as WebDriver names them.
namespace keys {
inline constexpr const char* left = "\uE012";
inline constexpr const char* right = "\uE014";
inline constexpr const char* home = "\uE011";
inline constexpr const char* enter = "\uE007";
inline constexpr const char* escape = "\uE00C";
}  // namespace keys

}  // namespace sluice
