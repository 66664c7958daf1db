#include "mspskel/io/atomic_file.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <utility>

#include "mspskel/base/error.h"

namespace mspskel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStage = "writing";

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw WriteError("cannot write " + path + ": " + reason);
}

// An open file that is closed again, whatever happens.
class OpenFile {
 public:
  explicit OpenFile(int number) : number_(number) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() { close(); }

  bool is_open() const { return number_ >= 0; }
  int number() const { return number_; }
  // Returns 0 or the error number: some disks say only then that they are full.
  int close() { return number_ < 0 || ::close(std::exchange(number_, -1)) == 0 ? 0 : errno; }

 private:
  int number_;
};

// Where nobody reads a pipe any more, writing to it is an error like others and no signal, which would end
// the program with temporary files behind. In this thread, while the object lives.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;
  ~NoPipeSignal() {
    const timespec at_once{};
    if (!was_pending_)
      while (sigtimedwait(&pipe_, nullptr, &at_once) < 0 && errno == EINTR) {
      }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  sigset_t pipe_, before_;
  bool was_pending_ = false;
};

// Until the file takes bytes, which a pipe does when it is read; asks meanwhile, and after a signal.
void await_room(int file, const ProgressCallback& progress, double share) {
  constexpr int kMilliseconds = 50;
  pollfd wanted{file, POLLOUT, 0};
  int ready = 0;
  while (ready == 0 || (ready < 0 && errno == EINTR)) {
    report_progress(progress, kStage, share);
    ready = ::poll(&wanted, 1, kMilliseconds);
  }
}

// Returns 0 or the error number. A pipe that has room takes PIPE_BUF bytes without waiting.
int write_all(int file, std::string_view bytes, bool may_wait, const ProgressCallback& progress) {
  constexpr std::size_t kBlock = std::size_t{1} << 18;
  const std::size_t block = may_wait ? PIPE_BUF : kBlock;
  for (std::size_t done = 0; done < bytes.size();) {
    const double share = static_cast<double>(done) / static_cast<double>(bytes.size());
    if (may_wait)
      await_room(file, progress, share);
    else
      report_progress(progress, kStage, share);
    const ssize_t written = ::write(file, bytes.data() + done, std::min(block, bytes.size() - done));
    if (written > 0)
      done += static_cast<std::size_t>(written);
    else if (written == 0 || (errno != EINTR && errno != EAGAIN))
      return written == 0 ? EIO : errno;
  }
  return 0;
}

bool is_stream(const std::string& path) {
  std::error_code ignored;
  return path == "-" || (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored));
}

void check_path(const std::string& path) {
  if (path.empty()) fail("''", "the file has no name");
  std::error_code ignored;
  if (path != "-" && fs::is_directory(path, ignored)) fail(path, "it is a directory");
}

void check_target(const std::string& path) {
  check_path(path);
  if (!is_stream(path)) refuse_write_protected(path);
}

void write_stream(const std::string& path, std::string_view bytes, const ProgressCallback& progress) {
  const NoPipeSignal no_signal;
  if (path == "-") {
    // What was printed before comes first.
    int error = std::fflush(stdout) == 0 ? 0 : errno;
    if (error == 0) error = write_all(STDOUT_FILENO, bytes, true, progress);
    if (error != 0) fail("standard output", std::strerror(error));
    return;
  }
  OpenFile file(::open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC));
  if (!file.is_open()) fail(path, std::strerror(errno));
  int error = write_all(file.number(), bytes, true, progress);
  if (error == 0) error = file.close();
  if (error != 0) fail(path, std::strerror(error));
}

// Creates a file that did not exist before, so that two processes never share one.
int open_temporary(const fs::path& target, fs::path& temporary) {
  constexpr int kTries = 1000;
  constexpr mode_t kAllThatTheUserAllows = 0666;
  for (int i = 0; i < kTries; ++i) {
    temporary = target;
    temporary += ".part" + std::to_string(i);
    const int file =
        ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kAllThatTheUserAllows);
    if (file >= 0 || errno != EEXIST) return file;
  }
  return -1;
}

// The file's name, which is there only if all is.
fs::path write_temporary(const std::string& path, const fs::path& target, std::string_view bytes,
                         const ProgressCallback& progress) {
  fs::path temporary;
  OpenFile file(open_temporary(target, temporary));
  if (!file.is_open()) fail(path, std::strerror(errno));
  std::error_code ignored;
  try {
    int error = write_all(file.number(), bytes, false, progress);
    if (error == 0) error = file.close();
    if (error != 0) fail(path, std::strerror(error));
  } catch (...) {
    fs::remove(temporary, ignored);
    throw;
  }
  return temporary;
}

void rename_to_target(const std::string& path, const fs::path& temporary, const fs::path& target) {
  // A file that is replaced keeps its mode bits.
  std::error_code ignored, renaming;
  const fs::file_status before = fs::status(target, ignored);
  if (fs::exists(before)) fs::permissions(temporary, before.permissions(), ignored);
  fs::rename(temporary, target, renaming);
  if (!renaming) return;
  fs::remove(temporary, ignored);
  fail(path, renaming.message());
}

}  // namespace

std::filesystem::path file_behind_links(const std::string& path) {
  constexpr int kMostLinks = 40;
  fs::path target = path;
  std::error_code failure;
  for (int i = 0; i < kMostLinks && fs::is_symlink(target, failure); ++i) {
    const fs::path next = fs::read_symlink(target, failure);
    if (failure) fail(path, failure.message());
    target = target.parent_path() / next;
  }
  if (fs::is_symlink(target, failure))
    fail(path, std::make_error_code(std::errc::too_many_symbolic_link_levels).message());
  return target;
}

void refuse_write_protected(const std::string& path) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  if (!fs::is_regular_file(status)) return;
  // A superuser may write to all files, and has protected some all the same.
  constexpr fs::perms kWrite = fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write;
  if ((status.permissions() & kWrite) == fs::perms::none ||
      (::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0 && errno != ENOENT))
    fail(path, "the file is write-protected; allow writing to it or give another name");
}

void write_file_atomically(const std::string& path, std::string_view bytes) {
  check_target(path);
  if (is_stream(path)) {
    write_stream(path, bytes, {});
    return;
  }
  const fs::path target = file_behind_links(path);
  rename_to_target(path, write_temporary(path, target, bytes, {}), target);
}

OutputFiles::OutputFiles(ProgressCallback progress) : progress_(std::move(progress)) {}

OutputFiles::~OutputFiles() {
  std::error_code ignored;
  for (const Temporary& temporary : files_) fs::remove(temporary.file, ignored);
  for (const fs::path& folder : folders_) fs::remove(folder, ignored);  // not if there is more in it
}

void OutputFiles::make_folder(const std::string& path) {
  std::error_code failure;
  const fs::path folder = fs::absolute(path, failure).lexically_normal();
  std::vector<fs::path> made;
  for (fs::path part = folder; !part.empty() && !fs::exists(part, failure); part = part.parent_path())
    made.push_back(part);
  folders_.insert(folders_.begin(), made.begin(), made.end());
  fs::create_directories(path, failure);
  if (failure) throw WriteError("cannot make the folder " + path + ": " + failure.message());
}

void OutputFiles::add(const std::string& path, std::string bytes) {
  report_progress(progress_, kStage, 0.0);
  check_target(path);
  if (is_stream(path)) {
    streams_.push_back({path, std::move(bytes)});
    return;
  }
  fs::path target = file_behind_links(path);
  fs::path temporary = write_temporary(path, target, bytes, progress_);
  files_.push_back({path, std::move(target), std::move(temporary)});
}

void OutputFiles::commit() {
  report_progress(progress_, kStage, 1.0);
  for (const Stream& stream : streams_) write_stream(stream.path, stream.bytes, progress_);
  streams_.clear();
  while (!files_.empty()) {
    const Temporary next = std::move(files_.front());
    files_.erase(files_.begin());
    rename_to_target(next.path, next.file, next.target);
  }
  folders_.clear();
}

}  // namespace mspskel
