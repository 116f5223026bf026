#include "cli/movie.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "image/png_rows.hpp"
#include "raytracer/error.hpp"

namespace raytracer::cli {

/// How ffmpeg makes a kind of film.
struct FilmFormat {
  std::string_view ending, muxer;
  bool has_even_size;                  // its pixels share colour in blocks of 2 x 2
  std::string_view arguments, colors;  // words with a blank between
};

namespace {

constexpr std::string_view kMp4 = "-c:v libx264 -preset medium -crf 18 -movflags +faststart";
constexpr std::string_view kWebm = "-c:v libvpx-vp9 -crf 24 -b:v 0 -row-mt 1";
// The colours that the whole film needs most, then every frame in them.
constexpr std::string_view kGif =
    "-filter_complex split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse -loop 0";
// Converted as HDTV has it, and told so: players guess differently where nothing is said.
constexpr std::string_view kVideoColors =
    "-vf scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int,format=yuv420p "
    "-color_range tv -colorspace bt709 -color_primaries bt709 -color_trc bt709";
constexpr FilmFormat kFormats[] = {
    {".mp4", "mp4", true, kMp4, kVideoColors},
    {".webm", "webm", false, kWebm, kVideoColors},
    {".gif", "gif", false, kGif, {}},
};

const FilmFormat* find_format(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  const auto found = std::ranges::find(kFormats, ending, &FilmFormat::ending);
  return found == std::end(kFormats) ? nullptr : found;
}

std::string find_ffmpeg(const std::string& film) {
  const char* variable = std::getenv("PATH");
  std::string_view folders = variable != nullptr ? variable : "/usr/local/bin:/usr/bin:/bin";
  while (!folders.empty()) {
    const std::size_t colon = std::min(folders.find(':'), folders.size());
    const std::string program = fmt::format("{}/ffmpeg", folders.substr(0, colon));
    if (colon > 0 && ::access(program.c_str(), X_OK) == 0) return program;
    folders.remove_prefix(std::min(colon + 1, folders.size()));
  }
  throw Error(ErrorKind::kFile,
              fmt::format("'{}' needs ffmpeg, which is not installed: apt install ffmpeg; "
                          "without it, -o shot.####.png makes frames and --frames all -o film.png "
                          "a PNG that moves",
                          film));
}

[[noreturn]] void refuse(const std::string& film, int error) {
  throw Error(ErrorKind::kFile,
              fmt::format("can't run ffmpeg for '{}': {}", film, std::generic_category().message(error)));
}

// Between fork and exec: only what a signal handler may do.
[[noreturn]] void become(const char* program, char* const* arguments, int input, int messages, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // whatever ends us ends ffmpeg too
  if (::getppid() != parent) ::_exit(127);
  ::dup2(input, STDIN_FILENO);
  ::dup2(messages, STDOUT_FILENO);
  ::dup2(messages, STDERR_FILENO);
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  for (const int number : {SIGPIPE, SIGXFSZ}) ::sigaction(number, &action, nullptr);
  // Ctrl-C reaches everything on the terminal; what becomes of ffmpeg is ours to say.
  action.sa_handler = SIG_IGN;
  ::sigaction(SIGINT, &action, nullptr);
  ::execv(program, arguments);
  ::_exit(127);
}

void put_channel(const std::vector<float>& values, std::size_t start, std::size_t width, std::uint8_t* out) {
  for (std::size_t x = 0; x < width; ++x) out[3 * x] = to_byte(values[start + x]);
}

void add_words(std::vector<std::string>& words, std::string_view text) {
  while (!text.empty()) {
    const std::size_t blank = std::min(text.find(' '), text.size());
    words.emplace_back(text.substr(0, blank));
    text.remove_prefix(std::min(blank + 1, text.size()));
  }
}

// Three bytes a pixel; the last column and row once more where the format wants even numbers.
std::vector<std::uint8_t> rgb_of(const Image& image, std::size_t width, std::size_t height) {
  const auto columns = static_cast<std::size_t>(image.width), rows = static_cast<std::size_t>(image.height);
  std::vector<std::uint8_t> bytes(3 * width * height);
  for (std::size_t y = 0; y < height; ++y) {
    const std::size_t start = columns * std::min(y, rows - 1);
    std::uint8_t* row = bytes.data() + 3 * width * y;
    put_channel(image.red, start, columns, row);
    put_channel(image.green, start, columns, row + 1);
    put_channel(image.blue, start, columns, row + 2);
    if (width > columns) std::copy_n(row + 3 * (columns - 1), 3, row + 3 * columns);
  }
  return bytes;
}

}  // namespace

bool is_film(const std::string& path) { return find_format(path) != nullptr; }

Movie::Movie(const std::string& path, double fps, RunStatistics& run, Stopwatch& watch)
    : path_(path),
      program_(find_ffmpeg(path)),
      format_(*find_format(path)),
      fps_(fps),
      run_(run),
      watch_(watch),
      file_(path) {}

Movie::~Movie() {
  close_pipe();
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    wait_for_end();
  }
  if (messages_ >= 0) ::close(messages_);
}

void Movie::add(int, const std::string&, const Image& image) {
  if (process_ < 0) {
    width_ = image.width;
    height_ = image.height;
    start();
  } else if (image.width != width_ || image.height != height_) {
    throw Error(ErrorKind::kUsage,
                fmt::format("a film's pictures have one size: this one is {}x{}, the first is {}x{}",
                            image.width, image.height, width_, height_));
  }
  const auto even = [&](int size) {
    return static_cast<std::size_t>(format_.has_even_size ? size + size % 2 : size);
  };
  bytes_ = rgb_of(image, even(width_), even(height_));
  repeat(0);
}

void Movie::repeat(int) {
  try {
    write_all(pipe_, bytes_, "ffmpeg");
  } catch (const Error&) {  // it has gone away, and says why
    close_pipe();
    fail(wait_for_end());
  }
  run_.encode += watch_.lap();
}

void Movie::finish() {
  close_pipe();
  const int status = wait_for_end();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail(status);
  run_.encode += watch_.lap();
  file_.finish();
  run_.write += watch_.lap();
}

std::vector<std::string> Movie::command_line() const {
  const int padding = format_.has_even_size ? 1 : 0;
  std::vector<std::string> words = {program_};
  add_words(words, "-hide_banner -loglevel error -y -f rawvideo -pixel_format rgb24");
  add_words(words, fmt::format("-video_size {}x{} -framerate {} -i pipe:0", width_ + width_ % 2 * padding,
                               height_ + height_ % 2 * padding, fps_));
  add_words(words, format_.arguments);
  add_words(words, format_.colors);
  add_words(words, fmt::format("-f {}", format_.muxer));
  words.push_back("file:" + file_.path());
  return words;
}

void Movie::start() {
  std::vector<std::string> words = command_line();
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  messages_ = ::memfd_create("ffmpeg", MFD_CLOEXEC);
  int ends[2] = {-1, -1};
  if (messages_ < 0 || ::pipe2(ends, O_CLOEXEC) != 0) refuse(path_, errno);
  pipe_ = ends[1];
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) become(program_.c_str(), arguments.data(), ends[0], messages_, parent);
  const int error = errno;
  ::close(ends[0]);
  if (process_ < 0) refuse(path_, error);
}

void Movie::fail(int status) {
  const std::string how = WIFSIGNALED(status) ? fmt::format("ended by signal {}", WTERMSIG(status))
                                              : fmt::format("exit code {}", WEXITSTATUS(status));
  throw Error(ErrorKind::kFile,
              fmt::format("ffmpeg could not make '{}' ({}):\n{}", path_, how, last_words()));
}

void Movie::close_pipe() {
  if (pipe_ >= 0) ::close(std::exchange(pipe_, -1));
}

int Movie::wait_for_end() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return status;
}

// What stands at the end of its messages.
std::string Movie::last_words() const {
  constexpr off_t kMost = 500;
  const off_t size = ::lseek(messages_, 0, SEEK_END);
  std::string text(static_cast<std::size_t>(std::min(size, kMost)), '\0');
  const ssize_t got = ::pread(messages_, text.data(), text.size(), std::max<off_t>(0, size - kMost));
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  if (size > kMost) text.erase(0, text.find('\n') + 1);  // the rest of a line says nothing
  while (text.ends_with('\n')) text.pop_back();
  return text.empty() ? "it said nothing" : text;
}

}  // namespace raytracer::cli
