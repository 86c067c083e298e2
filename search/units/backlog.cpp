// SPDX-License-Identifier: Apache-2.0
#include "search/units/backlog.h"

#include <tuple>

#include "corpus/record/kinds.h"

namespace stiction {

bool Backlog::Entry::operator<(const Entry& other) const {
  const auto rank = [](const Entry& e) {
    return std::tie(e.tries, e.finding.contacts, e.finding.unit, e.finding.index, e.finding.signature);
  };
  return rank(*this) < rank(other);
}

void Backlog::Add(Finding finding) {
  Forget(finding.signature);
  const Class of{finding.kind, finding.contacts};
  std::int64_t& size = sizes_[of];
  if (most_ && size >= *most_ && !IsGrave(finding.kind) && !finding.done) {
    left_out_.insert(finding.signature);
    return;
  }
  ++size;
  admitted_[finding.signature] = {of, finding.unit, finding.index};
  if (!finding.done) waiting_.insert({0, std::move(finding)});
}

std::optional<Backlog::Entry> Backlog::Take() {
  if (waiting_.empty()) return std::nullopt;
  return std::move(waiting_.extract(waiting_.begin()).value());
}

// Unless another one represents its group meanwhile.
void Backlog::GiveBack(Entry entry) {
  const auto admitted = admitted_.find(entry.finding.signature);
  if (admitted == admitted_.end() || admitted->second.unit != entry.finding.unit ||
      admitted->second.index != entry.finding.index)
    return;
  waiting_.insert(std::move(entry));
}

void Backlog::Forget(const std::string& signature) {
  left_out_.erase(signature);
  const auto admitted = admitted_.find(signature);
  if (admitted == admitted_.end()) return;
  --sizes_[admitted->second.of];
  admitted_.erase(admitted);
  std::erase_if(waiting_, [&](const Entry& other) { return other.finding.signature == signature; });
}

}  // namespace stiction
