// Shell completions from the rows of commands, options and the scene language's words.
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "raytracer/error.hpp"

namespace raytracer::cli {
namespace {

std::vector<const OptionRow*> shown_options(const CommandRow& command) {
  std::vector<const OptionRow*> rows;
  for (const OptionRow& row : all_options()) {
    if (!row.hidden && (row.commands & command.bit) != 0) rows.push_back(&row);
  }
  return rows;
}

// The names of the commands; those of the rows' other than `render` where it is left out.
std::string command_words(std::string_view between, bool with_render = true) {
  std::vector<std::string_view> words;
  for (const CommandRow& row : all_commands()) {
    if (with_render || row.bit != kRender) words.push_back(row.name);
  }
  return fmt::format("{}", fmt::join(words, between));
}

std::string topic_words() { return fmt::format("{}", fmt::join(help_topics(), " ")); }

// The branches of a `case` over the first word: what to do for each command, `render` for any other word.
template <class Body>
std::string case_branches(const Body& body) {
  std::string branches, otherwise;
  for (const CommandRow& row : all_commands()) {
    if (row.bit == kRender) {
      otherwise = fmt::format("    *) {} ;;\n", body(row));
    } else {
      branches += fmt::format("    {}) {} ;;\n", row.name, body(row));
    }
  }
  return branches + otherwise;
}

std::string bash() {
  const std::string options_of_command = case_branches([](const CommandRow& command) {
    std::vector<std::string_view> names;
    for (const OptionRow* row : shown_options(command)) names.push_back(row->name);
    return fmt::format("options=\"{}\"", fmt::join(names, " "));
  });
  return fmt::format(R"(_raytracer() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} options
  case ${{COMP_WORDS[1]}} in
{}  esac
  COMPREPLY=()
  if [[ $previous == --format ]]; then
    COMPREPLY=($(compgen -W "text json" -- "$current"))
  elif [[ $previous == --allow-path ]]; then
    COMPREPLY=($(compgen -d -- "$current"))
  elif [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$current"))
  elif [[ $previous == help ]]; then
    COMPREPLY=($(compgen -W "{}" -- "$current"))
  elif [[ $COMP_CWORD -eq 1 ]]; then
    COMPREPLY=($(compgen -f -W "{}" -- "$current"))
  else
    COMPREPLY=($(compgen -f -- "$current"))
  fi
}}
complete -o filenames -F _raytracer raytracer
)",
                     options_of_command, topic_words(), command_words(" "));
}

// For a text between single quotation marks.
std::string escape_quotes(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out;
}

std::string zsh_option(const OptionRow& row) {
  const std::string_view action = row.value == "DIR"      ? "_files -/"
                                  : row.value == "FILE"   ? "_files"
                                  : row.value == "FORMAT" ? "(text json)"
                                                          : " ";
  return fmt::format("'{}{}[{}]{}'", row.repeatable ? "*" : "", row.name, escape_quotes(row.help),
                     row.value.empty() ? "" : fmt::format(":{}:{}", row.value, action));
}

std::string zsh() {
  const std::string options_of_command = case_branches([](const CommandRow& command) {
    std::string options;
    for (const OptionRow* row : shown_options(command))
      options += fmt::format("\n      {}", zsh_option(*row));
    return fmt::format("options=({})", options);
  });
  return fmt::format(R"(#compdef raytracer
local -a commands options
commands=({})
if (( CURRENT == 2 )); then
  _describe command commands
fi
if [[ $words[2] == help && $words[CURRENT] != -* ]]; then
  compadd {}
  return
fi
case $words[2] in
{}esac
_arguments -s $options '*:scene:_files'
)",
                     command_words(" "), topic_words(), options_of_command);
}

std::string fish() {
  std::string lines =
      fmt::format("complete -c raytracer -n __fish_use_subcommand -a '{}'\n", command_words(" "));
  lines +=
      fmt::format("complete -c raytracer -n '__fish_seen_subcommand_from help' -f -a '{}'\n", topic_words());
  for (const CommandRow& command : all_commands()) {
    const std::string condition =
        command.bit == kRender ? fmt::format("not __fish_seen_subcommand_from {}", command_words(" ", false))
                               : fmt::format("__fish_seen_subcommand_from {}", command.name);
    for (const OptionRow* row : shown_options(command)) {
      const std::string alias = row->alias.empty() ? "" : fmt::format(" -s {}", row->alias.substr(1));
      lines += fmt::format("complete -c raytracer -n '{}' -l {}{}{} -d \"{}\"\n", condition,
                           row->name.substr(2), alias, row->value.empty() ? "" : " -r", row->help);
    }
  }
  return lines;
}

}  // namespace

std::string completions(const std::string& shell) {
  if (shell == "bash") return bash();
  if (shell == "zsh") return zsh();
  if (shell == "fish") return fish();
  throw Error(ErrorKind::kUsage,
              fmt::format("there are completions for bash, zsh and fish, not for '{}'", shell));
}

}  // namespace raytracer::cli
