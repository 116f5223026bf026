#include "cli/statistics.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>

#include "core/printable.hpp"

namespace raytracer::cli {

double Stopwatch::lap() {
  const Clock::time_point now = Clock::now();
  return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
}

double RunStatistics::million_rays_per_second() const {
  return static_cast<double>(rays) / 1e6 / std::max(render, 1e-9);
}

// What getrusage() says counts the process too that this one was before it became raytracer.
double peak_memory_in_megabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return std::strtod(line.c_str() + 6, nullptr) / 1024;  // in KiB
  }
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in KiB
}

std::string summary(const std::string& path, const RunStatistics& run) {
  std::string what = fmt::format("{} x {}", run.width, run.height);
  if (run.pictures > 1 || run.kept > 0) {
    const std::string kept =
        run.kept > 0 ? fmt::format(", {} of them there already", run.kept) : std::string();
    what = fmt::format("{} frames{}{}", run.pictures, run.width > 0 ? " of " + what : std::string(), kept);
  }
  return fmt::format("{}: {} in {:.2f} s, {:.1f} million rays at {:.1f} million/s, {:.0f} MB\n",
                     printable(path), what, run.total(), static_cast<double>(run.rays) / 1e6,
                     run.million_rays_per_second(), peak_memory_in_megabytes());
}

std::string to_json(const RunStatistics& run) {
  return fmt::format(
      R"({{"load": {:.6f}, "build": {:.6f}, "render": {:.6f}, "encode": {:.6f}, "write": {:.6f}, "total": {:.6f}, )"
      R"("rays": {}, "mrays_per_second": {:.3f}, "peak_mb": {:.1f}, "picture_mb": {:.3f}, "shapes": {}}})"
      "\n",
      run.load, run.build, run.render, run.encode, run.write, run.total(), run.rays,
      run.million_rays_per_second(), peak_memory_in_megabytes(),
      static_cast<double>(run.picture_bytes) / 1048576, run.shapes);
}

}  // namespace raytracer::cli
