// Shell completions from the rows of commands, options and kinds.
#include <fmt/format.h>

#include <set>

#include "cli/commands.hpp"
#include "raytracer/error.hpp"
#include "scene_file/schema.hpp"

namespace raytracer::cli {
namespace {

std::vector<const OptionRow*> shown_options() {
  std::vector<const OptionRow*> rows;
  for (const OptionRow& row : all_options()) {
    if (!row.hidden) rows.push_back(&row);
  }
  return rows;
}

std::string command_words() {
  std::string words;
  for (const CommandRow& row : all_commands()) words += fmt::format("{}{}", words.empty() ? "" : " ", row.name);
  return words;
}

std::string kind_words() {
  std::set<std::string_view> kinds;
  for (const scene_file::KindRow& row : scene_file::all_kinds()) kinds.insert(row.name);
  return fmt::format("{}", fmt::join(kinds, " "));
}

std::string bash() {
  std::string options;
  for (const OptionRow* row : shown_options()) options += fmt::format("{}{}", options.empty() ? "" : " ", row->name);
  return fmt::format(R"(_raytracer() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}
  COMPREPLY=()
  if [[ $previous == --format ]]; then
    COMPREPLY=($(compgen -W "text json" -- "$current"))
  elif [[ $previous == --allow-path ]]; then
    COMPREPLY=($(compgen -d -- "$current"))
  elif [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "{}" -- "$current"))
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
                     options, kind_words(), command_words());
}

std::string zsh() {
  std::string options;
  for (const OptionRow* row : shown_options()) {
    const std::string value = row->value.empty() ? "" : fmt::format(":{}:{}", row->value,
                                                                     row->value == "DIR"      ? "_files -/"
                                                                     : row->value == "FILE"   ? "_files"
                                                                     : row->value == "FORMAT" ? "(text json)"
                                                                                              : " ");
    options += fmt::format("  '{}[{}]{}' \\\n", row->name, row->help, value);
  }
  return fmt::format(R"(#compdef raytracer
local -a commands
commands=({})
if (( CURRENT == 2 )); then
  _describe command commands
fi
if [[ $words[2] == help ]]; then
  compadd {}
  return
fi
_arguments -s \
{}  '*:scene:_files'
)",
                     command_words(), kind_words(), options);
}

std::string fish() {
  std::string lines = fmt::format("complete -c raytracer -n __fish_use_subcommand -a '{}'\n", command_words());
  lines += fmt::format("complete -c raytracer -n '__fish_seen_subcommand_from help' -f -a '{}'\n", kind_words());
  for (const OptionRow* row : shown_options()) {
    const std::string alias = row->alias.empty() ? "" : fmt::format(" -s {}", row->alias.substr(1));
    lines += fmt::format("complete -c raytracer -l {}{}{} -d '{}'\n", row->name.substr(2), alias,
                         row->value.empty() ? "" : " -r", row->help);
  }
  return lines;
}

}  // namespace

std::string completions(const std::string& shell) {
  if (shell == "bash") return bash();
  if (shell == "zsh") return zsh();
  if (shell == "fish") return fish();
  throw Error(ErrorKind::kUsage, fmt::format("there are completions for bash, zsh and fish, not for '{}'", shell));
}

}  // namespace raytracer::cli
