#pragma once

#include <cstdlib>

#include <unistd.h>

namespace godobject::test {

/// Rights do not bind the superuser: there the test acts as another user for as long as this lasts.
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
