// SPDX-License-Identifier: Apache-2.0
#include "corpus/statistics.h"

#include <algorithm>
#include <vector>

namespace stiction {
namespace {

Json ToJson(const Statistics& statistics) {
  Json json = Json::object();
  ForEachField(statistics, [&json](const char* name, const char*, std::int64_t value) { json[name] = value; });
  return json;
}

Statistics StatisticsFromJson(const Json& json) {
  Statistics statistics;
  ForEachField(statistics, [&json](const char* name, const char*, std::int64_t& value) {
    value = json.at(name).get<std::int64_t>();
  });
  return statistics;
}

// Trailing zeros left out.
template <class Array>
Json Trimmed(const Array& values) {
  std::size_t size = values.size();
  while (size > 0 && values[size - 1] == 0) --size;
  return Json(std::vector<std::int64_t>(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(size)));
}

template <class Array>
void Fill(Array& values, const Json& json) {
  for (std::size_t i = 0; i < json.size(); ++i) values.at(i) = json[i].template get<std::int64_t>();
}

template <class Tally>
void AddCounters(Tally& sums, const Tally& tally) {
  std::vector<std::int64_t> theirs;
  ForEachCounter(tally, [&theirs](const char*, std::int64_t value) { theirs.push_back(value); });
  auto next = theirs.begin();
  ForEachCounter(sums, [&next](const char*, std::int64_t& mine) { mine += *next++; });
}

template <class Tally>
Json CountersToJson(int contacts, const Tally& tally) {
  Json json = {{"contacts", contacts}};
  ForEachCounter(tally, [&json](const char* name, std::int64_t value) { json[name] = value; });
  return json;
}

template <class Tally>
void FillCounters(Tally& tally, const Json& json) {
  ForEachCounter(tally, [&json](const char* name, std::int64_t& value) {
    value = json.at(name).template get<std::int64_t>();
  });
}

// [[value, count], ...]
Json ToJson(const std::map<int, std::int64_t>& histogram) {
  Json json = Json::array();
  for (const auto& [value, count] : histogram) json.push_back({value, count});
  return json;
}

void Fill(std::map<int, std::int64_t>& histogram, const Json& json) {
  for (const Json& bin : json) histogram[bin.at(0).get<int>()] = bin.at(1).get<std::int64_t>();
}

void AddTo(std::map<int, std::int64_t>& sums, const std::map<int, std::int64_t>& histogram) {
  for (const auto& [value, count] : histogram) sums[value] += count;
}

void AddTo(std::array<std::int64_t, kOutcomeCount>& sums,
           const std::array<std::int64_t, kOutcomeCount>& values) {
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += values[i];
}

}  // namespace

void Tally::Merge(const Tally& other) {
  problems += other.problems;
  AddTo(outcomes, other.outcomes);
  for (std::size_t i = 0; i < verdicts.size(); ++i) AddTo(verdicts[i], other.verdicts[i]);
  audited += other.audited;
  misjudged += other.misjudged;
  wrong += other.wrong;
  with_zero_steps += other.with_zero_steps;
  with_give_ups += other.with_give_ups;
  Add(other.sums, other.maxima);
  for (int i = 0; i < kBins; ++i) steps[i] += other.steps[i];
}

Json ToJson(const Tally& tally) {
  Json verdicts = Json::array();
  for (const auto& row : tally.verdicts) verdicts.push_back(Trimmed(row));
  return {{"problems", tally.problems},
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
}

Tally TallyFromJson(const Json& json) {
  Tally tally;
  tally.problems = json.at("problems").get<std::int64_t>();
  Fill(tally.outcomes, json.at("outcomes"));
  for (std::size_t i = 0; i < tally.verdicts.size(); ++i) Fill(tally.verdicts[i], json.at("verdicts").at(i));
  tally.audited = json.at("audited").get<std::int64_t>();
  tally.misjudged = json.at("misjudged").get<std::int64_t>();
  tally.wrong = json.at("wrong").get<std::int64_t>();
  tally.with_zero_steps = json.at("with_zero_steps").get<std::int64_t>();
  tally.with_give_ups = json.at("with_give_ups").get<std::int64_t>();
  tally.sums = StatisticsFromJson(json.at("sums"));
  tally.maxima = StatisticsFromJson(json.at("maxima"));
  Fill(tally.steps, json.at("steps"));
  return tally;
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
}

std::string Serialize(const Record& record) {
  Json tallies = Json::array();
  for (const auto& [key, tally] : record.tallies) {
    Json json = {{"generator", key.generator},
                 {"contacts", key.contacts},
                 {"policy", key.policy},
                 {"method", key.method},
                 {"arithmetic", key.arithmetic}};
    json.update(ToJson(tally));
    tallies.push_back(std::move(json));
  }
  Json signatures = Json::object();
  for (const auto& [signature, count] : record.signatures) signatures[signature] = count;
  Json existence = Json::array();
  for (const auto& [contacts, tally] : record.existence) existence.push_back(CountersToJson(contacts, tally));
  Json agreement = Json::array();
  for (const auto& [contacts, tally] : record.agreement) {
    Json entry = CountersToJson(contacts, tally);
    entry["words"] = ToJson(tally.words);
    entry["solutions"] = ToJson(tally.solutions);
    agreement.push_back(std::move(entry));
  }
  return Json{{"tallies", std::move(tallies)},
              {"signatures", std::move(signatures)},
              {"existence", std::move(existence)},
              {"agreement", std::move(agreement)}}
      .dump();
}

Record ParseRecord(const std::string& text) {
  const Json json = Json::parse(text);
  Record record;
  for (const Json& entry : json.at("tallies")) {
    const TallyKey key{entry.at("generator").get<std::string>(), entry.at("contacts").get<int>(),
                       entry.at("policy").get<std::string>(), entry.at("method").get<std::string>(),
                       entry.at("arithmetic").get<std::string>()};
    record.tallies[key] = TallyFromJson(entry);
  }
  for (const auto& [signature, count] : json.at("signatures").items()) {
    record.signatures[signature] = count.get<std::int64_t>();
  }
  for (const Json& entry : json.at("existence")) {
    FillCounters(record.existence[entry.at("contacts").get<int>()], entry);
  }
  for (const Json& entry : json.at("agreement")) {
    AgreementTally& tally = record.agreement[entry.at("contacts").get<int>()];
    FillCounters(tally, entry);
    Fill(tally.words, entry.at("words"));
    Fill(tally.solutions, entry.at("solutions"));
  }
  return record;
}

}  // namespace stiction
