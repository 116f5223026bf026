#include "image/write_file.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <filesystem>
#include <set>
#include <string>
#include <thread>

#include "catch.hpp"
#include "raytracer/error.hpp"
#include "raytracer/image.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;
using raytracer::check_writable;
using raytracer::Error;
using raytracer::ErrorKind;
using raytracer::write_file;

namespace {

using Bytes = std::vector<std::uint8_t>;

const Bytes kOld(1000, 'o');
const Bytes kNew(300000, 'n');

mode_t permissions(const std::string& path) {
  struct stat status = {};
  REQUIRE(stat(path.c_str(), &status) == 0);
  return status.st_mode & 07777;
}

template <typename Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    REQUIRE(error.kind() == ErrorKind::kFile);
    return error.what();
  }
  return "nothing was thrown";
}

/// What both of them say; they must agree.
std::string refusal(const std::string& path) {
  const std::string message = message_of([&] { check_writable(path); });
  REQUIRE(message_of([&] { write_file(path, kNew); }) == message);
  return message;
}

/// Runs `test` without root's rights, to which every file is writable. Must not use Catch.
template <typename Test>
bool holds_for_common_user(const Test& test) {
  const pid_t child = fork();
  if (child == 0) {
    constexpr uid_t kNobody = 65534;
    if (geteuid() == 0 && (setegid(kNobody) != 0 || seteuid(kNobody) != 0)) _exit(1);
    try {
      _exit(test() ? 0 : 1);
    } catch (const std::exception&) {
      _exit(1);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool throws_permission_denied(const std::string& path) {
  try {
    check_writable(path);
  } catch (const Error& error) {
    return std::string(error.what()).find("Permission denied") != std::string::npos;
  }
  return false;
}

/// No file may grow beyond 4096 bytes while it lives.
class SmallFilesOnly {
 public:
  SmallFilesOnly() {
    old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &old_limit_);
    const rlimit limit = {4096, old_limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallFilesOnly() {
    setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }
  SmallFilesOnly(const SmallFilesOnly&) = delete;
  SmallFilesOnly& operator=(const SmallFilesOnly&) = delete;

 private:
  rlimit old_limit_ = {};
  void (*old_handler_)(int) = nullptr;
};

}  // namespace

TEST_CASE("write_file makes a new file with the usual permissions", "[write_file]") {
  const TemporaryFolder folder;
  const mode_t old_mask = umask(027);
  check_writable(folder / "out.png");
  REQUIRE(folder.names().empty());
  write_file(folder / "out.png", kNew);
  umask(old_mask);
  REQUIRE((contents(folder / "out.png") == kNew));
  REQUIRE(permissions(folder / "out.png") == 0640);
  write_file(folder / "empty", {});
  REQUIRE(contents(folder / "empty").empty());
  REQUIRE(folder.names() == std::set<std::string>{"empty", "out.png"});
}

TEST_CASE("write_file writes into the current folder", "[write_file]") {
  const TemporaryFolder folder;
  const fs::path old = fs::current_path();
  fs::current_path(folder.path());
  write_file("out.png", kNew);
  fs::current_path(old);
  REQUIRE((contents(folder / "out.png") == kNew));
}

TEST_CASE("write_file replaces a file and keeps its permissions", "[write_file]") {
  const TemporaryFolder folder;
  const std::string path = folder / "out.png";
  write_file(path, kOld);
  REQUIRE(chmod(path.c_str(), 0604) == 0);
  const bool is_root = geteuid() == 0;
  if (is_root) REQUIRE(chown(path.c_str(), 12345, 23456) == 0);
  const int reader = open(path.c_str(), O_RDONLY);
  write_file(path, kNew);
  REQUIRE((contents(path) == kNew));
  REQUIRE(permissions(path) == 0604);
  struct stat status = {};
  REQUIRE(stat(path.c_str(), &status) == 0);
  REQUIRE(status.st_uid == (is_root ? 12345 : geteuid()));
  REQUIRE(folder.names() == std::set<std::string>{"out.png"});
  // Who has the old file open keeps reading it.
  Bytes old(kOld.size() + 1);
  REQUIRE(read(reader, old.data(), old.size()) == static_cast<ssize_t>(kOld.size()));
  close(reader);
}

TEST_CASE("write_file follows links", "[write_file]") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "deep");
  fs::create_symlink("deep/second", folder / "first");
  fs::create_symlink("../target", folder / "deep/second");
  write_file(folder / "first", kOld);
  REQUIRE((contents(folder / "target") == kOld));
  write_file(folder / "first", kNew);
  REQUIRE((contents(folder / "target") == kNew));
  REQUIRE(fs::is_symlink(folder / "first"));
  REQUIRE(fs::is_symlink(folder / "deep/second"));
  REQUIRE(folder.names() == std::set<std::string>{"deep", "first", "target"});

  fs::create_symlink("loop", folder / "loop");
  REQUIRE(refusal(folder / "loop") ==
          "can't write '" + (folder / "loop") + "': Too many levels of symbolic links");
}

TEST_CASE("a full file system leaves the old file and nothing else", "[write_file]") {
  const TemporaryFolder folder;
  const std::string path = folder / "out.png";
  write_file(path, kOld);
  {
    const SmallFilesOnly limit;
    const std::string reason = "': File too large";
    REQUIRE(message_of([&] { write_file(path, kNew); }) == "can't write '" + path + reason);
    REQUIRE(message_of([&] { write_file(folder / "b", kNew); }) == "can't write '" + (folder / "b") + reason);
  }
  REQUIRE((contents(path) == kOld));
  REQUIRE(folder.names() == std::set<std::string>{"out.png"});
  write_file(path, kNew);
  REQUIRE((contents(path) == kNew));
}

TEST_CASE("paths that can't be written are refused in clear words", "[write_file]") {
  const TemporaryFolder folder;
  write_file(folder / "file", kOld);
  REQUIRE(refusal("") == "the file to write has no name");
  REQUIRE(refusal(std::string("a\0b", 3)) == "can't write 'a': its name has a zero byte in it");
  REQUIRE(refusal(folder.path()) == "can't write '" + folder.path() + "': that is a folder");
  REQUIRE(refusal(folder / "new/") == "can't write '" + (folder / "new/") + "': that is a folder");
  REQUIRE(refusal("/") == "can't write '/': that is a folder");
  REQUIRE(refusal(folder / "x/out.png") ==
          "there is no folder '" + (folder / "x") + "' to write '" + (folder / "x/out.png") + "' into");
  REQUIRE(refusal("no-such-folder/out.png") ==
          "there is no folder 'no-such-folder' to write 'no-such-folder/out.png' into");
  REQUIRE(refusal(folder / "file/out.png") ==
          "can't write '" + (folder / "file/out.png") + "': '" + (folder / "file") + "' is not a folder");
  const std::string long_name = folder / std::string(300, 'x');
  REQUIRE(refusal(long_name) == "can't write '" + long_name + "': File name too long");
  REQUIRE(folder.names() == std::set<std::string>{"file"});
}

TEST_CASE("files and folders without permission are refused", "[write_file]") {
  const TemporaryFolder folder;
  REQUIRE(chmod(folder.path().c_str(), 0777) == 0);
  write_file(folder / "read-only", kOld);
  REQUIRE(chmod((folder / "read-only").c_str(), 0444) == 0);
  REQUIRE(holds_for_common_user([&] { return throws_permission_denied(folder / "read-only"); }));
  fs::create_directory(folder / "locked");
  REQUIRE(chmod((folder / "locked").c_str(), 0555) == 0);
  REQUIRE(holds_for_common_user([&] { return throws_permission_denied(folder / "locked/out.png"); }));
  // One may put files into a folder that one may not list.
  fs::create_directory(folder / "blind");
  REQUIRE(chmod((folder / "blind").c_str(), 0333) == 0);
  REQUIRE(holds_for_common_user([&] {
    write_file(folder / "blind/out.png", kNew);
    return true;
  }));
  REQUIRE(chmod((folder / "blind").c_str(), 0777) == 0);
  REQUIRE((contents(folder / "blind/out.png") == kNew));
}

TEST_CASE("devices and pipes are written directly", "[write_file]") {
  write_file("/dev/null", kNew);
  REQUIRE(fs::is_character_file("/dev/null"));
  REQUIRE(message_of([] { write_file("/dev/full", kNew); }) ==
          "can't write '/dev/full': No space left on device");

  const TemporaryFolder folder;
  const std::string pipe = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  check_writable(pipe);
  Bytes received;
  std::thread reader([&] { received = contents(pipe); });
  write_file(pipe, kNew);
  reader.join();
  REQUIRE((received == kNew));
  REQUIRE(fs::is_fifo(pipe));
}

TEST_CASE("a path of an open file writes on where that file stands", "[write_file]") {
  const TemporaryFolder folder;
  const int file = open((folder / "log").c_str(), O_CREAT | O_WRONLY | O_APPEND, 0600);
  REQUIRE(file >= 0);
  REQUIRE(write(file, "ab", 2) == 2);
  fs::create_symlink("/dev/fd/" + std::to_string(file), folder / "link");
  write_file("/dev/fd/" + std::to_string(file), {'c'});
  write_file("/proc/self/fd/" + std::to_string(file), {'d'});
  write_file(folder / "link", {'e'});
  REQUIRE(contents(folder / "log") == Bytes{'a', 'b', 'c', 'd', 'e'});
  close(file);
  const std::string gone = "/dev/fd/" + std::to_string(file);
  REQUIRE(refusal(gone) == "can't write '" + gone + "': Bad file descriptor");
  const int reader = open((folder / "log").c_str(), O_RDONLY);
  const std::string readable = "/dev/fd/" + std::to_string(reader);
  REQUIRE(refusal(readable) == "can't write '" + readable + "': it is open for reading only");
  close(reader);
}

TEST_CASE("write_all waits for a slow reader of a non-blocking pipe", "[write_file]") {
  int ends[2];
  REQUIRE(pipe2(ends, O_NONBLOCK) == 0);
  Bytes received;
  std::thread reader([&] {
    std::uint8_t buffer[10000];
    fcntl(ends[0], F_SETFL, 0);
    for (ssize_t n = 0; (n = read(ends[0], buffer, sizeof buffer)) > 0;)
      received.insert(received.end(), buffer, buffer + n);
  });
  raytracer::write_all(ends[1], kNew, "standard output");
  close(ends[1]);
  reader.join();
  REQUIRE((received == kNew));
  close(ends[0]);
}

TEST_CASE("write_all reports a reader that went away", "[write_file]") {
  const auto old_handler = std::signal(SIGPIPE, SIG_IGN);
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  close(ends[0]);
  REQUIRE(message_of([&] { raytracer::write_all(ends[1], kNew, "standard output"); }) ==
          "can't write 'standard output': Broken pipe");
  close(ends[1]);
  std::signal(SIGPIPE, old_handler);
}

TEST_CASE("several threads may write the same file", "[write_file]") {
  const TemporaryFolder folder;
  const std::string path = folder / "out.png";
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&, i] {
      for (int k = 0; k < 5; ++k) write_file(path, Bytes(100000, static_cast<std::uint8_t>(i)));
    });
  }
  for (std::thread& thread : threads) thread.join();
  const Bytes result = contents(path);
  REQUIRE(result.size() == 100000);
  REQUIRE((result == Bytes(100000, result[0])));
  REQUIRE(folder.names() == std::set<std::string>{"out.png"});
}

TEST_CASE("remove_unfinished_file touches nothing when nothing is unfinished", "[write_file]") {
  const TemporaryFolder folder;
  write_file(folder / "out.png", kOld);
  write_file(folder / "out.png", kNew);
  raytracer::remove_unfinished_file();
  REQUIRE((contents(folder / "out.png") == kNew));
}
