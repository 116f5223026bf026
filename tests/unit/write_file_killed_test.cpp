// What stays behind when the program dies, or can't go on, in the middle of write_file.
#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image/write_file.hpp"
#include "raytracer/image.hpp"
#include "temporary_folder.hpp"

using raytracer::write_file;

namespace {

using Bytes = std::vector<std::uint8_t>;
using Names = std::set<std::string>;

const Bytes kOld(1000, 'o');
const Bytes kNew(300000, 'n');

/// Runs `work` in a process of its own and gives its wait status; an exception makes that exit with 3. Must
/// not use Catch.
template <typename Work>
int status_of_child(const Work& work) {
  const pid_t child = fork();
  if (child == 0) {
    try {
      work();
    } catch (const std::exception&) {
      _exit(3);
    }
    _exit(0);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  return status;
}

bool exited_with(int status, int code) { return WIFEXITED(status) && WEXITSTATUS(status) == code; }

/// The 4097th byte written to a file raises SIGXFSZ.
void limit_file_size(void (*handler)(int)) {
  std::signal(SIGXFSZ, handler);
  const rlimit no_core = {0, 0}, limit = {4096, 4096};
  setrlimit(RLIMIT_CORE, &no_core);
  setrlimit(RLIMIT_FSIZE, &limit);
}

/// From here on this process gets ENOTSUP for what `filter` finds, as on some file systems.
template <unsigned short kSize>
void install(sock_filter (&filter)[kSize]) {
  const sock_fprog program = {kSize, filter};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
      prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0) {
    _exit(4);
  }
}

void forbid_naming_files() {
  sock_filter filter[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_linkat, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOTSUP),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  install(filter);
  if (linkat(AT_FDCWD, "/", AT_FDCWD, "/", 0) == 0 || errno != ENOTSUP) _exit(4);
}

void forbid_nameless_files() {
  constexpr unsigned kFlags = offsetof(seccomp_data, args) + 2 * sizeof(std::uint64_t);  // little-endian
  sock_filter filter[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_openat, 0, 3),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kFlags),
      BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, O_TMPFILE & ~O_DIRECTORY, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOTSUP),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  install(filter);
  if (open("/", O_TMPFILE | O_WRONLY, 0600) >= 0 || errno != ENOTSUP) _exit(4);
}

const TemporaryFolder* watched = nullptr;

/// Exits with 7 when a hidden file was there and is gone.
void remove_and_exit(int) {
  const std::size_t before = watched->names().size();
  raytracer::remove_unfinished_file();
  _exit(before == 2 && watched->names().size() == 1 ? 7 : 8);
}

/// Whether files can begin without a name here.
bool has_nameless_files(const TemporaryFolder& folder) {
  const int file = open(folder.path().c_str(), O_TMPFILE | O_WRONLY, 0600);
  if (file >= 0) close(file);
  return file >= 0;
}

}  // namespace

TEST_CASE("a program killed while it writes leaves the old file and nothing else", "[write_file]") {
  const TemporaryFolder folder;
  if (!has_nameless_files(folder)) return;
  write_file(folder / "out.png", kOld);
  for (const char* name : {"out.png", "new.png"}) {
    const int status = status_of_child([&] {
      limit_file_size(SIG_DFL);
      write_file(folder / name, kNew);
    });
    REQUIRE(WIFSIGNALED(status));
    REQUIRE(WTERMSIG(status) == SIGXFSZ);
    REQUIRE((contents(folder / "out.png") == kOld));
    REQUIRE(folder.names() == Names{"out.png"});
  }
}

TEST_CASE("where files can't begin without a name, write_file uses a hidden one", "[write_file]") {
  for (const auto forbid : {forbid_naming_files, forbid_nameless_files}) {
    const TemporaryFolder folder;
    write_file(folder / "out.png", kOld);
    REQUIRE(chmod((folder / "out.png").c_str(), 0604) == 0);
    const int status = status_of_child([&] {
      forbid();
      write_file(folder / "out.png", kNew);
      write_file(folder / "new.png", kNew);
    });
    REQUIRE(exited_with(status, 0));
    REQUIRE((contents(folder / "out.png") == kNew));
    REQUIRE((contents(folder / "new.png") == kNew));
    REQUIRE(folder.names() == Names{"new.png", "out.png"});
    struct stat replaced = {};
    REQUIRE(stat((folder / "out.png").c_str(), &replaced) == 0);
    REQUIRE((replaced.st_mode & 07777) == 0604);
  }
}

TEST_CASE("a hidden file that can't be written or meets a signal is removed", "[write_file]") {
  const TemporaryFolder folder;
  watched = &folder;
  write_file(folder / "out.png", kOld);
  const auto status_with = [&](void (*handler)(int)) {
    return status_of_child([&] {
      forbid_nameless_files();
      limit_file_size(handler);
      write_file(folder / "out.png", kNew);
    });
  };
  REQUIRE(exited_with(status_with(SIG_IGN), 3));
  REQUIRE(folder.names() == Names{"out.png"});
  REQUIRE(exited_with(status_with(remove_and_exit), 7));
  REQUIRE(folder.names() == Names{"out.png"});
  REQUIRE((contents(folder / "out.png") == kOld));
}

TEST_CASE("a hidden name that is taken is left alone", "[write_file]") {
  const TemporaryFolder folder;
  const int status = status_of_child([&] {
    forbid_nameless_files();
    write_file(folder / (".raytracer-" + std::to_string(getpid()) + "-0"), kOld);
    write_file(folder / "out.png", kNew);
  });
  REQUIRE(exited_with(status, 0));
  REQUIRE((contents(folder / "out.png") == kNew));
  REQUIRE(folder.names().size() == 2);
  for (const std::string& name : folder.names()) {
    if (name != "out.png") REQUIRE((contents(folder / name) == kOld));
  }
}
