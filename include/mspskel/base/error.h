// Every failure that a user can cause is one of these exceptions; the message names the offending element.
#pragma once

#include <stdexcept>
#include <string>

namespace mspskel {

// The values are the exit statuses of the command line.
enum class ErrorKind {
  kUsage = 1,       // an option or argument is wrong
  kRead = 2,        // a file cannot be read or parsed
  kMesh = 3,        // the mesh is not usable: open, non-manifold, not orientable, degenerate
  kWrite = 4,       // a file cannot be written
  kNoSkeleton = 5,  // no skeleton could be made
  kCancelled = 6,   // time limit, interrupt, or a progress callback that asked to stop
};

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const noexcept { return kind_; }

 private:
  ErrorKind kind_;
};

struct UsageError : Error {
  explicit UsageError(const std::string& message) : Error(ErrorKind::kUsage, message) {}
};
struct ReadError : Error {
  explicit ReadError(const std::string& message) : Error(ErrorKind::kRead, message) {}
};
struct MeshError : Error {
  explicit MeshError(const std::string& message) : Error(ErrorKind::kMesh, message) {}
};
struct WriteError : Error {
  explicit WriteError(const std::string& message) : Error(ErrorKind::kWrite, message) {}
};
struct NoSkeletonError : Error {
  explicit NoSkeletonError(const std::string& message) : Error(ErrorKind::kNoSkeleton, message) {}
};
struct Cancelled : Error {
  Cancelled() : Error(ErrorKind::kCancelled, "cancelled") {}
};

}  // namespace mspskel
