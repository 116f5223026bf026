// The command line: one row per command and per option. Parsing, --help, the man page and the shells'
// completions all read these rows.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/frames.hpp"
#include "raytracer/scene_file.hpp"

namespace raytracer::cli {

/// What the command line asks for.
struct Options {
  std::vector<std::string> operands;  ///< what is no option: the scene, or a topic of help
  std::string output;                 ///< empty: from the scene's name
  std::string statistics;             ///< where what the run took is written to; empty: nowhere
  std::optional<FrameList> frames;    ///< as --frames has them
  std::optional<double> time_at;      ///< seconds: one moment
  bool resume = false;                ///< keep the frames that are there
  LoadOptions load;
  int threads = 0;
  bool quiet = false;
  bool json = false;
  bool checks_form = false, in_place = false;  ///< of fmt
  bool wants_help = false, wants_version = false;
  bool wants_man_page = false, wants_markdown = false;
  std::string completions_for;  ///< a shell
};

enum CommandBit : std::uint8_t { kRender = 1, kCheck = 2, kHelp = 4, kParams = 8, kFmt = 16, kJson = 32 };

struct CommandRow {
  std::string_view name;
  CommandBit bit;
  std::string_view operands;  ///< as usage shows them
  std::string_view help;
  int (*run)(const Options& options);  ///< returns the exit code
  std::size_t most_operands = 1;
};

struct OptionRow {
  std::string_view name;   ///< with its dashes
  std::string_view alias;  ///< a short one, or empty
  std::string_view value;  ///< what stands behind it, or empty for a switch
  std::uint8_t commands;   ///< CommandBits
  bool hidden;             ///< for packagers: not in --help
  std::string_view help;
  void (*apply)(Options& options, const std::string& value);  ///< throws Error (kUsage)
  bool repeatable = false;
};

std::span<const CommandRow> all_commands();
std::span<const OptionRow> all_options();

/// The command that the first argument names, or `render`, with its options. Throws Error (kUsage).
struct ParsedCommandLine {
  const CommandRow* command = nullptr;
  Options options;
};
ParsedCommandLine parse_command_line(int argc, const char* const* argv);

}  // namespace raytracer::cli
