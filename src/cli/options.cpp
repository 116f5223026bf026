#include "cli/options.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>

#include "cli/commands.hpp"
#include "core/suggest.hpp"
#include "raytracer/error.hpp"
#include "scene_file/limits.hpp"
#include "scene_file/method.hpp"

namespace raytracer::cli {
namespace {

[[noreturn]] void usage_error(const std::string& message) { throw Error(ErrorKind::kUsage, message); }

// CLI11 would take 010 for 8 and "" for 0.
template <class Number>
Number whole_number(std::string_view option, std::string_view text, Number least, Number most) {
  Number number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, number);
  if (status != std::errc() || stop != end || number < least || number > most) {
    usage_error(fmt::format("{} takes a whole number from {} to {}, not '{}'", option, least, most, text));
  }
  return number;
}

void set_size(Options& options, const std::string& value) {
  const std::size_t cross = value.find_first_of("xX");
  if (cross == std::string::npos) {
    usage_error(fmt::format("--size takes WIDTHxHEIGHT, as 640x480, not '{}'", value));
  }
  const std::string_view text = value;
  options.load.width = whole_number<int>("--size", text.substr(0, cross), 1, 65536);
  options.load.height = whole_number<int>("--size", text.substr(cross + 1), 1, 65536);
}

void set_format(Options& options, const std::string& value) {
  if (value != "text" && value != "json") {
    usage_error(fmt::format("--format takes text or json, not '{}'", value));
  }
  options.json = value == "json";
}

void set_time(Options& options, const std::string& value) {
  double time = 0;
  const char* end = value.data() + value.size();
  const auto [stop, status] = std::from_chars(value.data(), end, time);
  if (status != std::errc() || stop != end || !(time >= 0 && time <= 1e6)) {
    usage_error(fmt::format("--time-at takes seconds from 0 to 1000000, as 1.5, not '{}'", value));
  }
  options.time_at = time;
}

void set_method(Options& options, const std::string& value) {
  options.load.method = scene_file::find_method(value);
  if (options.load.method) return;
  usage_error(fmt::format("--method takes {}, not '{}'", fmt::join(scene_file::kMethodWords, " or "), value));
}

void add_setting(Options& options, const std::string& value) {
  const std::size_t equals = value.find('=');
  if (equals == std::string::npos || equals == 0) {
    usage_error(fmt::format("--set takes NAME=VALUE, as --set n=24, not '{}'", value));
  }
  options.load.settings.push_back({value.substr(0, equals), value.substr(equals + 1)});
}

void set_limit(Options& options, const std::string& value) {
  const std::size_t equals = std::min(value.find('='), value.size());
  const std::string_view name = std::string_view(value).substr(0, equals);
  std::vector<std::string_view> known;
  for (const scene_file::LimitRow& row : scene_file::all_limits()) {
    known.push_back(row.name);
    if (row.name != name) continue;
    if (equals == value.size()) usage_error(fmt::format("--limit {0} needs a number: --limit {0}=N", name));
    constexpr std::uint64_t kMost = 1'000'000'000'000'000;
    options.load.limits.*row.field = whole_number<std::uint64_t>(
        fmt::format("--limit {}", name), std::string_view(value).substr(equals + 1), 1, kMost);
    return;
  }
  usage_error(
      fmt::format("--limit takes NAME=N, where NAME is one of {}, not '{}'", fmt::join(known, ", "), value));
}

void allow_folder(Options& options, const std::string& value) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(value, error);
  if (!std::filesystem::is_directory(status)) {
    usage_error(fmt::format("--allow-path takes a folder, and {} '{}'",
                            std::filesystem::exists(status) ? "that is none:" : "there is no", value));
  }
  options.load.allowed_folders.push_back(value);
}

constexpr std::uint8_t kLoading = kRender | kCheck | kParams;
constexpr std::uint8_t kAll = kRender | kCheck | kHelp | kParams | kFmt | kJson;

constexpr OptionRow kOptions[] = {
    {"--output", "-o", "FILE", kRender | kJson, false,
     "picture .png .exr .pfm, film .mp4 .webm .gif; - stdout",
     [](Options& o, const std::string& v) { o.output = v; }},
    {"--size", "", "WxH", kLoading, false, "width and height in pixels", set_size},
    {"--samples", "", "N", kLoading, false, "rays per pixel",
     [](Options& o, const std::string& v) {
       o.load.samples = whole_number<int>("--samples", v, 1, 1'000'000);
     }},
    {"--bounces", "", "N", kLoading, false, "reflections followed, or scatterings in method path",
     [](Options& o, const std::string& v) { o.load.bounces = whole_number<int>("--bounces", v, 0, 1000); }},
    {"--method", "", "METHOD", kLoading, false, "how light is computed: classic or path", set_method},
    {"--seed", "", "N", kLoading, false, "other sample points, other noise",
     [](Options& o, const std::string& v) {
       o.load.seed = whole_number<std::uint32_t>("--seed", v, 0, 2147483647);
     }},
    {"--camera", "", "NAME", kLoading, false, "the camera to use, where the scene has several",
     [](Options& o, const std::string& v) { o.load.camera = v; }},
    {"--allow-path", "", "DIR", kLoading | kJson, false, "a further folder that the scene may read from",
     allow_folder, true},
    {"--set", "", "NAME=VALUE", kLoading | kJson, false, "another value for a top-level let", add_setting,
     true},
    {"--limit", "", "NAME=N", kLoading | kJson, false, "raises a limit, as nesting=1000", set_limit, true},
    {"--frames", "", "LIST", kRender, false, "all, 3, 1-240, 1-240x2 or 3,7: frames of the animation",
     [](Options& o, const std::string& v) { o.frames = parse_frame_list(v); }},
    {"--time-at", "", "SECONDS", kRender | kJson, false, "the moment to show, instead of 0", set_time},
    {"--resume", "", "", kRender, false, "keeps frames of an earlier run that are still right",
     [](Options& o, const std::string&) { o.resume = true; }},
    {"--threads", "", "N", kRender, false, "processors to use; the picture is the same for any N",
     [](Options& o, const std::string& v) { o.threads = whole_number<int>("--threads", v, 1, 1024); }},
    {"--quiet", "-q", "", kRender, false, "no progress bar, no summary",
     [](Options& o, const std::string&) { o.quiet = true; }},
    {"--stats", "", "FILE", kRender, false, "writes times and counts as JSON; - standard output",
     [](Options& o, const std::string& v) { o.statistics = v; }},
    {"--format", "", "FORMAT", kCheck, false, "messages as text, or as json on standard output", set_format},
    {"--check", "", "", kFmt, false, "changes nothing; exit code 1 where it would",
     [](Options& o, const std::string&) { o.checks_form = true; }},
    {"--in-place", "", "", kFmt, false, "rewrites the files",
     [](Options& o, const std::string&) { o.in_place = true; }},
    {"--help", "-h", "", kAll, false, "this page",
     [](Options& o, const std::string&) { o.wants_help = true; }},
    {"--version", "", "", kAll, false, "the program's version",
     [](Options& o, const std::string&) { o.wants_version = true; }},
    {"--man", "", "", kHelp, true, "the man page",
     [](Options& o, const std::string&) { o.wants_man_page = true; }},
    {"--markdown", "", "", kHelp, true, "blocks, functions and limits as tables of Markdown",
     [](Options& o, const std::string&) { o.wants_markdown = true; }},
    {"--completions", "", "SHELL", kHelp, true, "completions for bash, zsh or fish",
     [](Options& o, const std::string& v) { o.completions_for = v; }},
};

constexpr CommandRow kCommands[] = {
    {"render", kRender, "SCENE", "makes a picture; the word may be left out", run_render},
    {"check", kCheck, "SCENE", "looks for mistakes and renders nothing", run_check},
    {"params", kParams, "SCENE", "lists what --set can change", run_params},
    {"json", kJson, "SCENE", "writes one moment of the scene, evaluated, as JSON", run_json},
    {"fmt", kFmt, "SCENE", "prints the scene's text in canonical form", run_fmt, 1'000'000},
    {"help", kHelp, "[WORD]", "lists the words of a scene, or explains one", run_help, 2},
};

// The command's option that was probably meant; empty where none is near.
std::string_view option_meant(const CommandRow& command, std::string_view word) {
  std::vector<std::string_view> known;
  std::vector<std::string_view> longer;  // those that begin with the word
  for (const OptionRow& row : kOptions) {
    if ((row.commands & command.bit) == 0 || row.hidden) continue;
    known.push_back(row.name);
    if (row.name.starts_with(word)) longer.push_back(row.name);
  }
  return longer.size() == 1 ? longer[0] : nearest_word(word, known);
}

// CLI11 takes `-help` apart and leaves `-elp`: this is the word as it was written.
std::string_view as_written(std::string_view rest, std::span<const std::string> arguments) {
  if (rest.starts_with("--")) return rest;
  for (const std::string& argument : arguments) {
    if (argument.starts_with('-') && argument.ends_with(rest.substr(1))) return argument;
  }
  return rest;
}

std::string unknown_option(const CommandRow& command, std::string_view word) {
  const std::string_view name = word.substr(0, word.find('='));
  const bool is_of_another = std::ranges::find(kOptions, name, &OptionRow::name) != std::end(kOptions) ||
                             std::ranges::find(kOptions, name, &OptionRow::alias) != std::end(kOptions);
  if (is_of_another) {
    return fmt::format("{} has no option '{}'; raytracer --help lists them", command.name, name);
  }
  const std::string_view meant = option_meant(command, name);
  return fmt::format(
      "there is no option '{}'{}", name,
      meant.empty() ? "; raytracer --help lists them" : fmt::format("; did you mean '{}'?", meant));
}

// CLI11's message begins with the option's name, with or without dashes, and speaks of arguments, TEXT and
// overrides.
std::string wrong_value(std::string_view message) {
  const std::string_view begin = message.substr(std::min(message.find_first_not_of('-'), message.size()));
  const std::string_view name = begin.substr(0, begin.find_first_of(": "));
  for (const OptionRow& row : kOptions) {
    if (row.name.substr(2) != name) continue;
    if (row.value.empty()) return fmt::format("{} takes no value", row.name);
    return fmt::format("{0} needs a value: {0} {1}", row.name, row.value);
  }
  return std::string(message);
}

std::string too_many_operands(const CommandRow& command, const std::vector<std::string>& operands) {
  // `raytracer chekc scene.txt` is a slip in the command.
  std::vector<std::string_view> names;
  for (const CommandRow& row : kCommands) names.push_back(row.name);
  const std::string_view nearest = nearest_word(operands[0], names);
  if (command.bit == kRender && !nearest.empty()) {
    return fmt::format("there is no command '{}'; did you mean '{}'?", operands[0], nearest);
  }
  return fmt::format("{} takes {}, found another one: '{}'", command.name,
                     command.most_operands == 1 ? "one argument" : "two words",
                     operands[command.most_operands]);
}

void add_options(CLI::App& app, const CommandRow& command, Options& options) {
  app.set_help_flag();
  app.allow_extras();
  for (const OptionRow& row : kOptions) {
    if ((row.commands & command.bit) == 0) continue;
    const std::string names = fmt::format("{}{}{}", row.alias, row.alias.empty() ? "" : ",", row.name);
    if (row.value.empty()) {
      app.add_flag_callback(names, [&options, &row] { row.apply(options, {}); })->disable_flag_override();
      continue;
    }
    const auto apply_all = [&options, &row](const std::vector<std::string>& values) {
      if (values.size() > 1 && !row.repeatable) usage_error(fmt::format("{} is given twice", row.name));
      for (const std::string& value : values) row.apply(options, value);
    };
    app.add_option_function<std::vector<std::string>>(names, apply_all)->allow_extra_args(false);
  }
}

}  // namespace

std::span<const CommandRow> all_commands() { return kCommands; }
std::span<const OptionRow> all_options() { return kOptions; }

ParsedCommandLine parse_command_line(int argc, const char* const* argv) {
  ParsedCommandLine parsed;
  parsed.command = &kCommands[0];
  std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  for (const CommandRow& row : kCommands) {
    if (!arguments.empty() && arguments.front() == row.name) {
      parsed.command = &row;
      arguments.erase(arguments.begin());
      break;
    }
  }
  Options& options = parsed.options;
  CLI::App app;
  add_options(app, *parsed.command, options);
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ParseError& error) {
    usage_error(wrong_value(error.what()));
  }
  bool options_ended = false;
  for (const std::string& word : app.remaining()) {
    if (word == "--" && !options_ended) {
      options_ended = true;
      continue;
    }
    if (!options_ended && word.size() > 1 && word[0] == '-') {
      usage_error(unknown_option(*parsed.command, as_written(word, arguments)));
    }
    options.operands.push_back(word);
  }
  if (options.operands.size() > parsed.command->most_operands) {
    usage_error(too_many_operands(*parsed.command, options.operands));
  }
  return parsed;
}

}  // namespace raytracer::cli
