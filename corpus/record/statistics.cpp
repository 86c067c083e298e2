// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/statistics.h"

#include <fmt/format.h>

#include <charconv>

#include "corpus/json.h"

namespace stiction {
namespace {

Json ToJson(const Statistics& statistics) {
  Json json = Json::object();
  ForEachField(statistics, [&json](const char* name, const char*, std::int64_t value) { json[name] = value; });
  return json;
}

// Trailing zeros left out.
template <class Array>
Json Trimmed(const Array& values) {
  std::size_t size = values.size();
  while (size > 0 && values[size - 1] == 0) --size;
  return Json(std::vector<std::int64_t>(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(size)));
}

template <class Tally>
Json CountersToJson(const Tally& tally, Json json) {
  ForEachCounter(tally, [&json](const char* name, std::int64_t value) { json[name] = value; });
  return json;
}

// [[value, count], ...]
Json ToJson(const std::map<int, std::int64_t>& histogram) {
  Json json = Json::array();
  for (const auto& [value, count] : histogram) json.push_back({value, count});
  return json;
}

void AddTo(std::map<int, std::int64_t>& sums, const std::map<int, std::int64_t>& histogram) {
  for (const auto& [value, count] : histogram) sums[value] += count;
}

void AddTo(std::array<std::int64_t, kOutcomeCount>& sums,
           const std::array<std::int64_t, kOutcomeCount>& values) {
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += values[i];
}

// A list, since there are many: ReadStratum says of what.
Json ToJson(const StratumKey& key, const Stratum& stratum) {
  return Json::array({key.friction, key.rank, stratum.problems, stratum.steps, stratum.zero_steps,
                      stratum.audited, stratum.misjudged, Trimmed(stratum.outcomes), Trimmed(stratum.exact)});
}

}  // namespace

SharedJson ToJson(const TallyKey& key) {
  return {{"generator", key.generator},
          {"contacts", key.contacts},
          {"policy", key.policy},
          {"method", key.method},
          {"arithmetic", key.arithmetic}};
}

void Stratum::Merge(const Stratum& other) {
  problems += other.problems;
  steps += other.steps;
  zero_steps += other.zero_steps;
  audited += other.audited;
  misjudged += other.misjudged;
  AddTo(outcomes, other.outcomes);
  AddTo(exact, other.exact);
}

void WordSketch::Add(std::uint64_t hash) {
  const auto place = std::lower_bound(hashes_.begin(), hashes_.end(), hash);
  if (place != hashes_.end() && *place == hash) return;
  hashes_.insert(place, hash);
  if (hashes_.size() > kMost) hashes_.pop_back();
}

void WordSketch::Merge(const WordSketch& other) {
  for (const std::uint64_t hash : other.hashes_) Add(hash);
}

double WordSketch::Count() const {
  if (IsExact()) return static_cast<double>(hashes_.size());
  return static_cast<double>(kMost - 1) * 0x1p64 / static_cast<double>(hashes_.back());
}

void Tally::Merge(const Tally& other) {
  problems += other.problems;
  AddTo(outcomes, other.outcomes);
  for (std::size_t i = 0; i < verdicts.size(); ++i) AddTo(verdicts[i], other.verdicts[i]);
  audited += other.audited;
  misjudged += other.misjudged;
  for (std::size_t i = 0; i < rungs.size(); ++i) rungs[i] += other.rungs[i];
  wrong += other.wrong;
  with_zero_steps += other.with_zero_steps;
  with_give_ups += other.with_give_ups;
  Add(other.sums, other.maxima);
  for (int i = 0; i < kBins; ++i) steps[i] += other.steps[i];
  for (const auto& [key, stratum] : other.strata) strata[key].Merge(stratum);
}

Json ToJson(const Tally& tally) {
  Json verdicts = Json::array();
  for (const auto& row : tally.verdicts) verdicts.push_back(Trimmed(row));
  Json json = {{"problems", tally.problems},
               {"outcomes", Trimmed(tally.outcomes)},
               {"verdicts", verdicts},
               {"audited", tally.audited},
               {"misjudged", tally.misjudged},
               {"wrong", tally.wrong},
               {"with_zero_steps", tally.with_zero_steps},
               {"with_give_ups", tally.with_give_ups},
               {"sums", ToJson(tally.sums)},
               {"maxima", ToJson(tally.maxima)},
               {"steps", Trimmed(tally.steps)}};
  if (const Json rungs = Trimmed(tally.rungs); !rungs.empty()) json["rungs"] = rungs;
  Json strata = Json::array();
  for (const auto& [key, stratum] : tally.strata) strata.push_back(ToJson(key, stratum));
  json["strata"] = std::move(strata);
  return json;
}

void Record::Merge(const Record& other) {
  for (const auto& [key, tally] : other.tallies) tallies[key].Merge(tally);
  for (const auto& [signature, count] : other.signatures) signatures[signature] += count;
  for (const auto& [contacts, tally] : other.existence) AddCounters(existence[contacts], tally);
  for (const auto& [contacts, tally] : other.agreement) {
    AgreementTally& mine = agreement[contacts];
    AddCounters(mine, tally);
    AddTo(mine.words, tally.words);
    AddTo(mine.solutions, tally.solutions);
  }
  for (const auto& [contacts, tally] : other.loops) {
    AddCounters(loops[contacts], tally);
    AddTo(loops[contacts].by_zero_steps, tally.by_zero_steps);
  }
  for (const auto& [signature, sketch] : other.words) words[signature].Merge(sketch);
  for (const auto& [key, tally] : other.under_test) AddCounters(under_test[key], tally);
}

std::string Serialize(const Record& record) {
  Json tallies = Json::array();
  for (const auto& [key, tally] : record.tallies) {
    Json json = ToJson(key);
    json.update(ToJson(tally));
    tallies.push_back(std::move(json));
  }
  Json signatures = Json::object();
  for (const auto& [signature, count] : record.signatures) signatures[signature] = count;
  Json existence = Json::array();
  for (const auto& [contacts, tally] : record.existence)
    existence.push_back(CountersToJson(tally, {{"contacts", contacts}}));
  Json agreement = Json::array();
  for (const auto& [contacts, tally] : record.agreement) {
    Json entry = CountersToJson(tally, {{"contacts", contacts}});
    entry["words"] = ToJson(tally.words);
    entry["solutions"] = ToJson(tally.solutions);
    agreement.push_back(std::move(entry));
  }
  Json loops = Json::array();
  for (const auto& [contacts, tally] : record.loops) {
    Json entry = CountersToJson(tally, {{"contacts", contacts}});
    entry["by_zero_steps"] = ToJson(tally.by_zero_steps);
    loops.push_back(std::move(entry));
  }
  Json words = Json::object();
  for (const auto& [signature, sketch] : record.words) {
    Json& hashes = words[signature] = Json::array();
    for (const std::uint64_t hash : sketch.hashes()) hashes.push_back(fmt::format("{:016x}", hash));
  }
  Json json = {{"tallies", std::move(tallies)},     {"signatures", std::move(signatures)},
               {"existence", std::move(existence)}, {"agreement", std::move(agreement)},
               {"loops", std::move(loops)},         {"words", std::move(words)}};
  for (const auto& [key, tally] : record.under_test)
    json["under_test"].push_back(CountersToJson(tally, {{"generator", key.generator},
                                                        {"contacts", key.contacts},
                                                        {"friction", key.friction},
                                                        {"rank", key.rank},
                                                        {"spread", key.spread}}));
  return JsonText(json);
}

// ---- Reading ---------------------------------------------------------------------------------

namespace {

// More than any campaign counts; thousands of them add up within 64 bits.
constexpr std::int64_t kMostCounted = std::int64_t{1} << 48;

std::int64_t ReadCount(const JsonPlace& place) {
  return place.Integer(0, kMostCounted, fmt::format("a count, at most {}", kMostCounted));
}
std::int64_t ReadCount(const JsonPlace& place, const char* name) {
  return ReadCount(place.Required(name, "a count"));
}

int ReadSmall(const JsonPlace& place) {
  constexpr int kMost = 1 << 20;
  return static_cast<int>(place.Integer(0, kMost, fmt::format("a number from 0 to {}", kMost)));
}

// Counters; what is not there at the end is zero.
template <class Array>
void ReadCounts(const JsonPlace& place, Array& values) {
  const std::string expected = fmt::format("a list of at most {} counts", values.size());
  const std::size_t size = place.Size(expected);
  if (size > values.size()) place.Refuse(expected);
  for (std::size_t i = 0; i < size; ++i) values[i] = ReadCount(place[i]);
}

Statistics ReadStatistics(const JsonPlace& place) {
  Statistics statistics;
  std::vector<std::string> names;
  place.RequireObject();
  ForEachField(statistics, [&](const char* name, const char*, std::int64_t& value) {
    names.emplace_back(name);
    value = ReadCount(place, name);
  });
  place.AllowKeys(names);
  return statistics;
}

// `others`: keys that stand beside the counters.
template <class Tally>
void ReadCounters(const JsonPlace& place, Tally& tally, std::vector<std::string> others) {
  ForEachCounter(tally, [&](const char* name, std::int64_t& value) {
    others.emplace_back(name);
    if (std::string_view(name) != kNotInOlderRecords || place.Optional(name)) value = ReadCount(place, name);
  });
  place.AllowKeys(others);
}

// The place of a key in a map that does not have it yet.
template <class Map, class Key>
auto& PlaceFor(Map& map, const Key& key, const JsonPlace& entry, const char* expected) {
  const auto [place, is_new] = map.try_emplace(key);
  if (!is_new) entry.Refuse("a second one", expected);
  return place->second;
}

void ReadHistogram(const JsonPlace& place, std::map<int, std::int64_t>& histogram) {
  const std::size_t bins = place.Size("a list of pairs [value, count]");
  for (std::size_t i = 0; i < bins; ++i) {
    const JsonPlace bin = place[i];
    if (bin.Size("a pair [value, count]") != 2) bin.Refuse("a pair [value, count]");
    PlaceFor(histogram, ReadSmall(bin[0]), bin, "each value once") = ReadCount(bin[1]);
  }
}

// visit(element) for every element of a list.
template <class Visit>
void ForEachIn(const JsonPlace& list, const Visit& visit) {
  const std::size_t size = list.Size("a list");
  for (std::size_t i = 0; i < size; ++i) visit(list[i]);
}

// A text that a person or a program may have written: 16 hexadecimal digits.
std::uint64_t ReadHash(const JsonPlace& place) {
  const std::string text = place.Text("16 hexadecimal digits");
  std::uint64_t hash = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), hash, 16);
  if (text.size() != 16 || read.ec != std::errc() || read.ptr != text.data() + text.size())
    place.Refuse("16 hexadecimal digits");
  return hash;
}

void ReadStratum(const JsonPlace& place, std::map<StratumKey, Stratum>& strata) {
  const std::string expected =
      "[friction, rank, problems, steps, zero steps, audited, misjudged, outcomes, exact outcomes]";
  if (place.Size(expected) != 9) place.Refuse(expected);
  Stratum& stratum = PlaceFor(strata, StratumKey{place[0].Text("a friction"), ReadSmall(place[1])}, place,
                              "each friction and rank once");
  int at = 2;
  for (std::int64_t* count :
       {&stratum.problems, &stratum.steps, &stratum.zero_steps, &stratum.audited, &stratum.misjudged})
    *count = ReadCount(place[at++]);
  ReadCounts(place[7], stratum.outcomes);
  ReadCounts(place[8], stratum.exact);
}

Tally ReadTally(const JsonPlace& place) {
  Tally tally;
  place.RequireObject();
  place.AllowKeys({"generator", "contacts", "policy", "method", "arithmetic", "problems", "outcomes",
                   "verdicts", "audited", "misjudged", "rungs", "wrong", "with_zero_steps", "with_give_ups",
                   "sums", "maxima", "steps", "strata"});
  tally.problems = ReadCount(place, "problems");
  ReadCounts(place.Required("outcomes", "counts"), tally.outcomes);
  const JsonPlace verdicts = place.Required("verdicts", "a list of counts for every outcome");
  if (verdicts.Size("a list of lists") != tally.verdicts.size()) verdicts.Refuse("a list for every outcome");
  for (std::size_t i = 0; i < tally.verdicts.size(); ++i) ReadCounts(verdicts[i], tally.verdicts[i]);
  tally.audited = ReadCount(place, "audited");
  tally.misjudged = ReadCount(place, "misjudged");
  tally.wrong = ReadCount(place, "wrong");
  tally.with_zero_steps = ReadCount(place, "with_zero_steps");
  tally.with_give_ups = ReadCount(place, "with_give_ups");
  tally.sums = ReadStatistics(place.Required("sums", "counters"));
  tally.maxima = ReadStatistics(place.Required("maxima", "counters"));
  ReadCounts(place.Required("steps", "counts"), tally.steps);
  if (const auto rungs = place.Optional("rungs")) ReadCounts(*rungs, tally.rungs);
  ForEachIn(place.Required("strata", "a list"),
            [&tally](const JsonPlace& stratum) { ReadStratum(stratum, tally.strata); });
  return tally;
}

UnderTestKey ReadUnderTestKey(const JsonPlace& place) {
  const auto text = [&place](const char* name) { return place.Required(name, "a text").Text("a text"); };
  const auto small = [&place](const char* name) { return ReadSmall(place.Required(name, "a number")); };
  return {text("generator"), small("contacts"), text("friction"), small("rank"), small("spread")};
}

TallyKey ReadKey(const JsonPlace& place) {
  const auto text = [&place](const char* name) { return place.Required(name, "a text").Text("a text"); };
  return {text("generator"), ReadSmall(place.Required("contacts", "a number")), text("policy"), text("method"),
          text("arithmetic")};
}

}  // namespace

Record ParseRecord(const std::string& text, const std::string& source) {
  const JsonPlace root(text, source);
  root.RequireObject();
  root.AllowKeys({"tallies", "signatures", "existence", "agreement", "loops", "words", "under_test"});
  Record record;
  ForEachIn(root.Required("tallies", "a list"), [&record](const JsonPlace& entry) {
    PlaceFor(record.tallies, ReadKey(entry), entry, "each generator, size and policy once") = ReadTally(entry);
  });
  for (const auto& [signature, count] : root.Required("signatures", "counts by signature").Members())
    record.signatures[signature] = ReadCount(count);
  ForEachIn(root.Required("existence", "a list"), [&record](const JsonPlace& entry) {
    const int contacts = ReadSmall(entry.Required("contacts", "a number"));
    ReadCounters(entry, PlaceFor(record.existence, contacts, entry, "each size once"), {"contacts"});
  });
  ForEachIn(root.Required("agreement", "a list"), [&record](const JsonPlace& entry) {
    const int contacts = ReadSmall(entry.Required("contacts", "a number"));
    AgreementTally& tally = PlaceFor(record.agreement, contacts, entry, "each size once");
    ReadCounters(entry, tally, {"contacts", "words", "solutions"});
    ReadHistogram(entry.Required("words", "a list"), tally.words);
    ReadHistogram(entry.Required("solutions", "a list"), tally.solutions);
  });
  ForEachIn(root.Required("loops", "a list"), [&record](const JsonPlace& entry) {
    const int contacts = ReadSmall(entry.Required("contacts", "a number"));
    LoopTally& tally = PlaceFor(record.loops, contacts, entry, "each size once");
    ReadCounters(entry, tally, {"contacts", "by_zero_steps"});
    ReadHistogram(entry.Required("by_zero_steps", "a list"), tally.by_zero_steps);
  });
  if (const auto under_test = root.Optional("under_test")) {
    ForEachIn(*under_test, [&record](const JsonPlace& entry) {
      UnderTestTally& tally =
          PlaceFor(record.under_test, ReadUnderTestKey(entry), entry, "each kind of problems once");
      ReadCounters(entry, tally, {"generator", "contacts", "friction", "rank", "spread"});
    });
  }
  for (const auto& [signature, list] : root.Required("words", "hashes by signature").Members()) {
    WordSketch& sketch = record.words[signature];
    ForEachIn(list, [&sketch](const JsonPlace& hash) { sketch.Add(ReadHash(hash)); });
    if (sketch.hashes().size() != list.Size("a list"))
      list.Refuse(fmt::format("at most {} hashes, each once", WordSketch::kMost));
  }
  return record;
}

}  // namespace stiction
