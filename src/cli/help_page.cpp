// What --help prints, and the man page.
#include <fmt/format.h>

#include "cli/commands.hpp"

namespace raytracer::cli {
namespace {

struct Example {
  std::string_view line, help;
};
constexpr Example kExamples[] = {
    {"raytracer scene.txt", "makes scene.png"},
    {"raytracer scene.txt -o big.png --size 1920x1080", "another name and size"},
    {"raytracer help sphere", "what a sphere can have"},
};

struct ExitCode {
  std::string_view code, meaning;
};
constexpr ExitCode kExitCodes[] = {
    {"0", "done"},
    {"1", "the scene is wrong"},
    {"2", "the command line is wrong"},
    {"3", "the scene can't be read or the picture not written"},
    {"130, 143", "interrupted"},
};

std::string option_title(const OptionRow& row) {
  return fmt::format("{}{}{}{}{}", row.alias, row.alias.empty() ? "    " : ", ", row.name,
                     row.value.empty() ? "" : " ", row.value);
}

// What the option is for; one of a single command other than render says so.
std::string option_help(const OptionRow& row) {
  for (const CommandRow& command : all_commands()) {
    if (row.commands == command.bit && command.bit != kRender)
      return fmt::format("{}: {}", command.name, row.help);
  }
  return std::string(row.help);
}

std::string escape_roff(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '-' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

}  // namespace

std::string help_page() {
  std::string page = "raytracer turns a text file into a picture.\n\n";
  for (const CommandRow& row : all_commands()) {
    page +=
        fmt::format("  raytracer {:<15} {}\n",
                    fmt::format("{} {}", row.bit == kRender ? "[render]" : row.name, row.operands), row.help);
  }
  page += '\n';
  for (const OptionRow& row : all_options()) {
    if (!row.hidden) page += fmt::format("  {:<21} {}\n", option_title(row), option_help(row));
  }
  page += '\n';
  for (const Example& example : kExamples) page += fmt::format("  {:<48}  {}\n", example.line, example.help);
  return page;
}

std::string man_page() {
  std::string page = fmt::format(".TH RAYTRACER 1 \"\" \"raytracer {}\"\n", RAYTRACER_VERSION);
  page += ".SH NAME\nraytracer \\- turns a text file into a picture\n.SH SYNOPSIS\n";
  for (const CommandRow& row : all_commands()) {
    page += fmt::format(".B raytracer\n{} {} [\\fIoptions\\fR]\n.br\n",
                        row.bit == kRender ? "[render]" : row.name, row.operands);
  }
  page += ".SH COMMANDS\n";
  for (const CommandRow& row : all_commands()) {
    page += fmt::format(".TP\n.B {} \\fI{}\\fR\n{}\n", row.name, row.operands, escape_roff(row.help));
  }
  page += ".SH OPTIONS\n";
  for (const OptionRow& row : all_options()) {
    if (row.hidden) continue;
    page += fmt::format(".TP\n\\fB{}{}{}\\fR{}\n{}\n", escape_roff(row.alias), row.alias.empty() ? "" : ", ",
                        escape_roff(row.name), row.value.empty() ? "" : fmt::format(" \\fI{}\\fR", row.value),
                        escape_roff(option_help(row)));
  }
  page += ".SH EXIT STATUS\n";
  for (const ExitCode& row : kExitCodes) page += fmt::format(".TP\n.B {}\n{}\n", row.code, row.meaning);
  page += ".SH EXAMPLES\n";
  for (const Example& example : kExamples) {
    page += fmt::format(".TP\n.B {}\n{}\n", escape_roff(example.line), escape_roff(example.help));
  }
  return page;
}

}  // namespace raytracer::cli
