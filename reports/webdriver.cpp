#include "reports/webdriver.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace sluice {
namespace {

using nlohmann::json;

std::string find_program(std::initializer_list<const char*> names) {
  const char* path = std::getenv("PATH");
  for (const char* name : names) {
    std::istringstream directories(path == nullptr ? "" : path);
    for (std::string directory; std::getline(directories, directory, ':');) {
      std::string candidate = directory + "/" + name;
      if (access(candidate.c_str(), X_OK) == 0) return candidate;
    }
  }
  return "";
}

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error("browser: " + what);
}

/// The output stays open: a driver that could not write would end.
struct Driver {
  pid_t process = -1;
  int port = 0;
  std::FILE* output = nullptr;
};

/// Starts chromedriver on a port of its choice and reads from its output which one that is.
Driver start_driver(const std::string& program) {
  std::array<int, 2> output{};
  if (pipe(output.data()) != 0) fail("no pipe");
  const pid_t child = fork();
  if (child == 0) {
    setpgid(0, 0);  // so that it ends with everything that it has started
    dup2(output[1], STDOUT_FILENO);
    dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
    close(output[0]);
    execl(program.c_str(), program.c_str(), "--port=0", static_cast<char*>(nullptr));
    _exit(127);
  }
  close(output[1]);
  Driver driver{child, 0, fdopen(output[0], "r")};
  std::array<char, 512> line{};
  while (driver.port == 0 && std::fgets(line.data(), static_cast<int>(line.size()), driver.output) != nullptr)
    if (const char* at = std::strstr(line.data(), "successfully on port "); at != nullptr)
      driver.port = std::atoi(at + std::strlen("successfully on port "));
  if (driver.port == 0) fail(program + " did not start");
  return driver;
}

/// Whether an answer is there in full: chromedriver keeps its connections open, so that only the head tells.
bool is_complete(const std::string& answer) {
  const std::size_t head = answer.find("\r\n\r\n");
  const std::size_t field = answer.find("Content-Length:");
  if (head == std::string::npos || field == std::string::npos || field > head) return false;
  return answer.size() >= head + 4 + std::strtoul(answer.c_str() + field + std::strlen("Content-Length:"), nullptr, 10);
}

/// One request to this machine; the whole answer, head included.
std::string ask(int port, const std::string& request) {
  const int connection = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const timeval patience{120, 0};
  setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(connection, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    close(connection);
    fail(fmt::format("no connection to the driver: {}", std::strerror(errno)));
  }
  for (std::size_t sent = 0; sent < request.size();) {
    const ssize_t more = write(connection, request.data() + sent, request.size() - sent);
    if (more <= 0) break;
    sent += static_cast<std::size_t>(more);
  }
  std::string answer;
  std::array<char, 65536> part{};
  while (!is_complete(answer)) {
    const ssize_t size = read(connection, part.data(), part.size());
    if (size <= 0) break;
    answer.append(part.data(), static_cast<std::size_t>(size));
  }
  close(connection);
  return answer;
}

std::string decode_base64(const std::string& text) {
  static const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::size_t value = alphabet.find(c);
    if (value == std::string::npos) break;
    bits = bits << 6 | static_cast<unsigned>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xffu);
  }
  return bytes;
}

}  // namespace

BrowserPrograms find_browser() {
  return {find_program({"chromium", "chromium-browser", "google-chrome"}), find_program({"chromedriver"})};
}

Browser::Browser(const BrowserPrograms& programs, const std::filesystem::path& profile) {
  const Driver driver = start_driver(programs.chromedriver);
  driver_ = driver.process;
  port_ = driver.port;
  output_ = driver.output;
  const json arguments = {"--headless=new",
                          "--no-sandbox",
                          "--disable-gpu",
                          "--disable-dev-shm-usage",
                          "--host-resolver-rules=MAP * ~NOTFOUND",
                          "--user-data-dir=" + profile.string()};
  const json wanted = {{"browserName", "chrome"},
                       {"goog:loggingPrefs", {{"browser", "ALL"}}},
                       {"goog:chromeOptions", {{"binary", programs.chromium}, {"args", arguments}}}};
  const json session = send("POST", "/session", {{"capabilities", {{"alwaysMatch", wanted}}}});
  session_ = "/session/" + session.at("sessionId").get<std::string>();
}

Browser::~Browser() {
  try {
    if (!session_.empty()) send("DELETE", session_);
  } catch (const std::exception&) {  // it goes down with its process group
  }
  kill(-driver_, SIGTERM);
  waitpid(driver_, nullptr, 0);
  std::fclose(output_);
}

json Browser::send(const std::string& method, const std::string& path, const json& body) const {
  const std::string text = body.is_null() ? "" : body.dump();
  const std::string answer = ask(port_, fmt::format("{} {} HTTP/1.1\r\nHost: localhost\r\n"
                                                    "Content-Type: application/json\r\nContent-Length: {}\r\n\r\n{}",
                                                    method, path, text.size(), text));
  const std::size_t head = answer.find("\r\n\r\n");
  if (head == std::string::npos) fail("no answer to " + path);
  const json content = json::parse(answer.substr(head + 4), nullptr, false);
  if (!content.is_object() || !content.contains("value")) fail("no JSON in the answer to " + path);
  const json& value = content["value"];
  if (value.is_object() && value.contains("error"))
    fail(fmt::format("{}: {}", value["error"].get<std::string>(), value["message"].get<std::string>()));
  return value;
}

std::string Browser::element(const std::string& css) const {
  return send("POST", session_ + "/element", {{"using", "css selector"}, {"value", css}}).begin()->get<std::string>();
}

void Browser::open(const std::filesystem::path& page) {
  send("POST", session_ + "/url", {{"url", "file://" + std::filesystem::absolute(page).string()}});
}

void Browser::resize(int width, int height) {
  send("POST", session_ + "/goog/cdp/execute",
       {{"cmd", "Emulation.setDeviceMetricsOverride"},
        {"params", {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}}}});
}

void Browser::click(const std::string& css) {
  send("POST", session_ + "/element/" + element(css) + "/click", json::object());
}

void Browser::click_beside(const std::string& css, int right, int below) {
  const std::string id = element(css);
  evaluate(fmt::format("document.querySelector('{}').scrollIntoView({{block: 'center'}})", css));
  const json origin = {{"element-6066-11e4-a52e-4f735466cecf", id}};
  const json move = {{"type", "pointerMove"}, {"duration", 0}, {"origin", origin}, {"x", right}, {"y", below}};
  const json press = {{"type", "pointerDown"}, {"button", 0}}, release = {{"type", "pointerUp"}, {"button", 0}};
  const json mouse = {{"type", "pointer"}, {"id", "mouse"}, {"actions", json::array({move, press, release})}};
  send("POST", session_ + "/actions", {{"actions", json::array({mouse})}});
}

void Browser::type(const std::string& css, const std::string& keys) {
  send("POST", session_ + "/element/" + element(css) + "/value", {{"text", keys}});
}

std::string Browser::text(const std::string& css) {
  return send("GET", session_ + "/element/" + element(css) + "/text").get<std::string>();
}

std::size_t Browser::count(const std::string& css) {
  return send("POST", session_ + "/elements", {{"using", "css selector"}, {"value", css}}).size();
}

bool Browser::shown(const std::string& css) {
  return send("GET", session_ + "/element/" + element(css) + "/displayed").get<bool>();
}

json Browser::evaluate(const std::string& body) {
  return send("POST", session_ + "/execute/sync", {{"script", body}, {"args", json::array()}});
}

std::vector<std::string> Browser::complaints() {
  std::vector<std::string> all;
  for (const json& entry : send("POST", session_ + "/se/log", {{"type", "browser"}}))
    if (entry.at("level") == "SEVERE" || entry.at("level") == "WARNING") all.push_back(entry.at("message"));
  return all;
}

void Browser::set_medium(const std::string& medium) {
  send("POST", session_ + "/goog/cdp/execute",
       {{"cmd", "Emulation.setEmulatedMedia"}, {"params", {{"media", medium}}}});
}

void Browser::print(const std::filesystem::path& pdf) {
  std::ofstream(pdf, std::ios::binary) << decode_base64(
      send("POST", session_ + "/print", json::object()).get<std::string>());
}

void Browser::screenshot(const std::filesystem::path& png) {
  std::ofstream(png, std::ios::binary) << decode_base64(send("GET", session_ + "/screenshot").get<std::string>());
}

}  // namespace sluice
