// The commands, a file each. Every function returns the exit code; what goes wrong is thrown as Error.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/options.hpp"

namespace raytracer::cli {

int run_render(const Options& options);
int run_check(const Options& options);
int run_help(const Options& options);
int run_params(const Options& options);
int run_fmt(const Options& options);
int run_json(const Options& options);

/// The page behind --help, and what packagers install.
std::string help_page();
std::string man_page();
std::string completions(const std::string& shell);
/// Every word that `help` explains.
std::vector<std::string_view> help_topics();

/// The scene that the command line names; its messages are printed to standard error.
LoadedScene load_and_report(const Options& options);

}  // namespace raytracer::cli
