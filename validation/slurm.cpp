#include "validation/slurm.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "validation/printable.h"
#include "validation/toml_reader.h"

namespace sluice {
namespace {

constexpr int most_threads = 1024;
constexpr double report_memory_bytes = 1e9;

/// Room for what a plan does not count: libraries, buffers, the checkpoint that is made in memory.
std::int64_t megabytes(double bytes) {
  return static_cast<std::int64_t>(std::ceil(1.5 * bytes / 1e6)) + 200;
}

/// A line of its own in a script must stay one line.
bool is_word(std::string_view text) {
  return !text.empty() && text.find_first_of(" \"'`$\\") == std::string_view::npos &&
         printable(text, text.size()) == text;
}

std::optional<int> digits(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

/// Numbers between colons, three at most.
std::optional<std::vector<int>> clock_parts(std::string_view text) {
  std::vector<int> parts;
  for (bool more = true; more;) {
    const auto colon = text.find(':');
    const auto part = digits(text.substr(0, colon));
    if (!part || parts.size() == 3) return std::nullopt;
    parts.push_back(*part);
    more = colon != std::string_view::npos;
    text = more ? text.substr(colon + 1) : std::string_view{};
  }
  return parts;
}

int positive_integer(TomlReader& reader, std::string_view key, int fallback, int most) {
  if (!reader.has(key)) return fallback;
  const int value = reader.integer(key);
  if (value < 1 || value > most) reader.fail(key, fmt::format("is {}, must be 1 to {}", value, most));
  return value;
}

/// sbatch puts things of its own in the place of % in the names of files.
std::string log_file(const std::filesystem::path& out, std::string_view name) {
  std::string folder;
  for (const char c : (out / "slurm").string()) folder += c == '%' ? std::string("%%") : std::string(1, c);
  return fmt::format("\"{}/{}\"", folder, name);
}

/// A campaign may be called anything, a job not.
std::string job_name(std::string name) {
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '_') c = '-';
  return "sluice-" + name;
}

std::string directives(const SlurmJob& job, const std::string& name, double memory_bytes, int threads,
                       std::string_view log) {
  std::string text = "#!/bin/bash\n";
  const auto add = [&](const std::string& option) { text += "#SBATCH " + option + "\n"; };
  add("--job-name=" + name);
  add("--nodes=1 --ntasks=1");
  add(fmt::format("--cpus-per-task={}", threads));
  add(fmt::format("--mem={}M", megabytes(memory_bytes)));
  if (!job.options.partition.empty()) add("--partition=" + job.options.partition);
  if (!job.options.time_limit.empty()) add("--time=" + job.options.time_limit);
  add(fmt::format("--chdir=\"{}\"", job.working_directory.string()));
  add("--output=" + log_file(job.out, log));
  add("--open-mode=append");
  for (const std::string& option : job.options.options) add(option);
  return text;
}

std::string campaign_command(const SlurmJob& job) {
  return fmt::format("{} campaign {} --out {}", shell_quoted(job.program.string()), shell_quoted(job.campaign.string()),
                     shell_quoted(job.out.string()));
}

/// The program runs beside the shell, which alone hears of the time limit (USR1). SIGTERM, from who cancels or requeues
/// the task, comes to both; the program must not get it again later, since that ends it without a checkpoint.
constexpr const char* task_begin = R"(
sluice=
at_limit=
heard=
told=
tell() {
  [[ -z $sluice || $told ]] || { told=1; kill -TERM "$sluice"; }
}
trap 'at_limit=1; heard=1; echo "$run: told to make room"; tell' USR1
trap 'heard=1' TERM
)";
constexpr const char* task_end = R"( &
sluice=$!
[[ -z $at_limit ]] || tell # what came before its number was known
wait "$sluice"
code=$?
while [[ $heard ]]; do
  heard=
  wait "$sluice"
  code=$?
done
if [[ $at_limit && $code -eq 143 ]]; then
  echo "$run: out of time, back into the queue"
  trap - TERM
  # Ends this script. SLURM_JOB_ID of one of the tasks is the whole array's number, and would put all of it back.
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
  sleep 60
fi
exit "$code"
)";

}  // namespace

SlurmOptions parse_slurm(TomlReader reader) {
  SlurmOptions slurm;
  slurm.partition = reader.text_or("partition", "");
  slurm.time_limit = reader.text_or("time_limit", "");
  slurm.threads = positive_integer(reader, "threads", slurm.threads, most_threads);
  slurm.at_once = positive_integer(reader, "at_once", slurm.at_once, 1'000'000);
  slurm.warning_s = positive_integer(reader, "warning_s", slurm.warning_s, 65'535);
  if (reader.has("options")) slurm.options = reader.texts("options");
  reader.finish();
  if (const std::string problem = slurm_problem(slurm); !problem.empty()) reader.fail("", problem);
  return slurm;
}

std::optional<double> time_limit_s(std::string_view text) {
  const auto dash = text.find('-');
  const bool has_days = dash != std::string_view::npos;
  const auto days = has_days ? digits(text.substr(0, dash)) : 0;
  const auto parts = clock_parts(has_days ? text.substr(dash + 1) : text);
  if (!days || !parts) return std::nullopt;
  // Hours come first behind days; without days one number is minutes, and two are minutes and seconds.
  std::array<int, 3> clock{};
  const std::size_t first = has_days || parts->size() == 3 ? 0 : 1;
  for (std::size_t k = 0; k < parts->size(); ++k) clock.at(first + k) = (*parts)[k];
  return 86400.0 * *days + 3600.0 * clock[0] + 60.0 * clock[1] + clock[2];
}

std::string slurm_problem(const SlurmOptions& slurm) {
  if (!slurm.partition.empty() && !is_word(slurm.partition))
    return fmt::format("partition `{}` cannot be one's name", printable(slurm.partition));
  for (const std::string& option : slurm.options)
    if (!option.starts_with('-') || !is_word(option))
      return fmt::format("option `{}` is not like --account=name, without blanks and quotes", printable(option));
  if (slurm.time_limit.empty()) return "";
  const auto limit_s = time_limit_s(slurm.time_limit);
  if (!limit_s)
    return fmt::format("time limit `{}` is not like 90 (minutes), 12:00:00 or 2-12:00:00", printable(slurm.time_limit));
  // Slurm may give the warning a minute early.
  if (*limit_s < slurm.warning_s + 60)
    return fmt::format("time limit {} leaves no time before the warning at {} s before it (give more time)",
                       slurm.time_limit, slurm.warning_s);
  return "";
}

void refuse_odd_paths(const SlurmJob& job) {
  for (const auto& path : {job.working_directory, job.out}) {
    const std::string text = path.string();
    if (text.find_first_of("\"\\") != std::string::npos || printable(text, text.size()) != text)
      throw std::runtime_error(
          fmt::format("{}: sbatch cannot take a path with quotes, backslashes or control characters (choose another)",
                      printable(text)));
  }
}

std::string slurm_runs_script(const SlurmJob& job) {
  const SlurmOptions& slurm = job.options;
  std::string text =
      directives(job, job_name(job.name), static_cast<double>(job.memory_bytes), slurm.threads, "%A_%a.log");
  text += fmt::format("#SBATCH --array=1-{}{}\n", job.runs.size(),
                      slurm.at_once > 0 ? fmt::format("%{}", slurm.at_once) : "");
  text += fmt::format("#SBATCH --requeue --signal=B:USR1@{}\n", slurm.warning_s);
  text += "runs=(\n";
  for (const std::string& run : job.runs) text += "  " + shell_quoted(run) + "\n";
  text += ")\nrun=${runs[SLURM_ARRAY_TASK_ID - 1]}";
  text += task_begin;
  text += fmt::format("{} --threads {} --checkpoint-every {:g} --only \"$run\"", campaign_command(job), slurm.threads,
                      job.checkpoint_every_s);
  return text + task_end;
}

std::string slurm_report_script(const SlurmJob& job) {
  return directives(job, job_name(job.name) + "-report", report_memory_bytes, 1, "report-%j.log") + "exec " +
         campaign_command(job) + " --report-only\n";
}

}  // namespace sluice
