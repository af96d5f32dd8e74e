#pragma once

#include <cstdlib>

#include <unistd.h>

namespace godobject::test {

/// Switches a test that runs as root to the user `nobody` for its lifetime, because file permissions do not stop root.
class AsOrdinaryUser {
 public:
  AsOrdinaryUser() : user_(::geteuid()), changed_(user_ == 0 && ::seteuid(kNobody) == 0) {}
  ~AsOrdinaryUser() {
    if (changed_ && ::seteuid(user_) != 0) std::abort();
  }
  AsOrdinaryUser(const AsOrdinaryUser&) = delete;
  AsOrdinaryUser& operator=(const AsOrdinaryUser&) = delete;

  bool holds() const { return ::geteuid() != 0; }

 private:
  static constexpr uid_t kNobody = 65534;
  uid_t user_;
  bool changed_;
};

}  // namespace godobject::test
