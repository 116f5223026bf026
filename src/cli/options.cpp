#include "cli/options.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <charconv>

#include "cli/commands.hpp"
#include "core/suggest.hpp"
#include "raytracer/error.hpp"

namespace raytracer::cli {
namespace {

[[noreturn]] void usage_error(const std::string& message) { throw Error(ErrorKind::kUsage, message); }

// CLI11 would take 010 for 8 and "" for 0.
int whole_number(std::string_view option, std::string_view text, int least, int most) {
  int number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, number);
  if (status != std::errc() || stop != end || number < least || number > most) {
    usage_error(fmt::format("{} takes a whole number from {} to {}, not '{}'", option, least, most, text));
  }
  return number;
}

void set_size(Options& options, const std::string& value) {
  const std::size_t cross = value.find_first_of("xX");
  if (cross == std::string::npos) usage_error(fmt::format("--size takes WIDTHxHEIGHT, as 640x480, not '{}'", value));
  const std::string_view text = value;
  options.load.width = whole_number("--size", text.substr(0, cross), 1, 65536);
  options.load.height = whole_number("--size", text.substr(cross + 1), 1, 65536);
}

void set_format(Options& options, const std::string& value) {
  if (value != "text" && value != "json") usage_error(fmt::format("--format takes text or json, not '{}'", value));
  options.json = value == "json";
}

constexpr std::uint8_t kLoading = kRender | kCheck;
constexpr std::uint8_t kAll = kRender | kCheck | kHelp;

constexpr OptionRow kOptions[] = {
    {"--output", "-o", "FILE", kRender, false, "the picture, .png or .pfm; - is standard output",
     [](Options& o, const std::string& v) { o.output = v; }},
    {"--size", "", "WxH", kLoading, false, "width and height in pixels",
     [](Options& o, const std::string& v) { set_size(o, v); }},
    {"--samples", "", "N", kLoading, false, "rays per pixel",
     [](Options& o, const std::string& v) { o.load.samples = whole_number("--samples", v, 1, 1'000'000); }},
    {"--bounces", "", "N", kLoading, false, "reflections followed",
     [](Options& o, const std::string& v) { o.load.bounces = whole_number("--bounces", v, 0, 1000); }},
    {"--camera", "", "NAME", kLoading, false, "the camera to use, where the scene has several",
     [](Options& o, const std::string& v) { o.load.camera = v; }},
    {"--allow-path", "", "DIR", kLoading, false, "a further folder that the scene may read from",
     [](Options& o, const std::string& v) { o.load.allowed_folders.push_back(v); }},
    {"--threads", "", "N", kRender, false, "processors to use; the picture is the same for any N",
     [](Options& o, const std::string& v) { o.threads = whole_number("--threads", v, 1, 1024); }},
    {"--quiet", "-q", "", kRender, false, "no progress bar, no summary",
     [](Options& o, const std::string&) { o.quiet = true; }},
    {"--format", "", "FORMAT", kCheck, false, "messages as text, or as json on standard output",
     [](Options& o, const std::string& v) { set_format(o, v); }},
    {"--help", "-h", "", kAll, false, "this page", [](Options& o, const std::string&) { o.wants_help = true; }},
    {"--version", "", "", kAll, false, "the program's version",
     [](Options& o, const std::string&) { o.wants_version = true; }},
    {"--man", "", "", kHelp, true, "the man page", [](Options& o, const std::string&) { o.wants_man_page = true; }},
    {"--completions", "", "SHELL", kHelp, true, "completions for bash, zsh or fish",
     [](Options& o, const std::string& v) { o.completions_for = v; }},
};

constexpr CommandRow kCommands[] = {
    {"render", kRender, "SCENE", "makes a picture; the word may be left out", run_render},
    {"check", kCheck, "SCENE", "looks for mistakes and renders nothing", run_check},
    {"help", kHelp, "[KIND]", "lists the blocks of the scene language, or explains one", run_help},
};

std::string unknown_option(const CommandRow& command, std::string_view word) {
  std::vector<std::string_view> known;
  for (const OptionRow& row : kOptions) {
    if ((row.commands & command.bit) != 0 && !row.hidden) known.push_back(row.name);
  }
  const std::string_view name = word.substr(0, word.find('='));
  const std::string_view nearest = nearest_word(name, known);
  return fmt::format("there is no option '{}'{}", name,
                     nearest.empty() ? "; raytracer --help lists them" : fmt::format("; did you mean '{}'?", nearest));
}

std::string too_many_operands(const CommandRow& command, const std::vector<std::string>& operands) {
  // `raytracer chekc scene.txt` is a slip in the command.
  std::vector<std::string_view> names;
  for (const CommandRow& row : kCommands) names.push_back(row.name);
  const std::string_view nearest = nearest_word(operands[0], names);
  if (command.bit == kRender && !nearest.empty()) {
    return fmt::format("there is no command '{}'; did you mean '{}'?", operands[0], nearest);
  }
  return fmt::format("{} takes one argument, found another one: '{}'", command.name, operands[1]);
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
  app.set_help_flag();
  app.allow_extras();
  for (const OptionRow& row : kOptions) {
    if ((row.commands & parsed.command->bit) == 0) continue;
    const std::string names = fmt::format("{}{}{}", row.alias, row.alias.empty() ? "" : ",", row.name);
    if (row.value.empty()) {
      app.add_flag_callback(names, [&options, &row] { row.apply(options, {}); });
    } else {
      const bool repeatable = row.name == "--allow-path";
      app.add_option_function<std::vector<std::string>>(
             names,
             [&options, &row, repeatable](const std::vector<std::string>& values) {
               if (values.size() > 1 && !repeatable) usage_error(fmt::format("{} is given twice", row.name));
               for (const std::string& value : values) row.apply(options, value);
             })
          ->allow_extra_args(false);
    }
  }
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ParseError& error) {
    usage_error(error.what());
  }
  bool options_ended = false;
  for (const std::string& word : app.remaining()) {
    if (word == "--" && !options_ended) {
      options_ended = true;
      continue;
    }
    if (!options_ended && word.size() > 1 && word[0] == '-') usage_error(unknown_option(*parsed.command, word));
    options.operands.push_back(word);
  }
  if (options.operands.size() > 1) usage_error(too_many_operands(*parsed.command, options.operands));
  return parsed;
}

}  // namespace raytracer::cli
