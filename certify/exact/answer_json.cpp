// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/answer_json.h"

#include "corpus/json.h"

namespace stiction {
namespace {

Json EnclosuresToJson(const std::vector<Enclosure>& values) {
  Json json = Json::array();
  for (const Enclosure& x : values) json.push_back({NumberToJson(x.low), NumberToJson(x.high)});
  return json;
}

template <class Scalar>
void AddVectors(const Answer<Scalar>& answer, Json& json) {
  if (answer.f_enclosed.empty()) {
    json["f"] = answer.f.size() > 0 || answer.Solved() ? ListJson(answer.f) : Json(nullptr);
    json["a"] = answer.a.size() > 0 || answer.Solved() ? ListJson(answer.a) : Json(nullptr);
  } else {
    json["f"] = EnclosuresToJson(answer.f_enclosed);
    json["a"] = EnclosuresToJson(answer.a_enclosed);
  }
  if (answer.ray.size() > 0) json["ray"] = ListJson(answer.ray);
}

// Of contacts, the first is 1; null where nothing is missed.
void AddErrors(const Errors<double>& errors, Json& json) {
  json["residual"] = NumberToJson(errors.Largest());
  json["acceleration_error"] = NumberToJson(errors.acceleration);
  json["force_error"] = NumberToJson(errors.force);
  json["backward_error"] = NumberToJson(errors.backward);
  json["amplification"] = NumberToJson(errors.amplification);
  json["worst_contact"] = errors.contact < 0 ? Json(nullptr) : Json(errors.contact + 1);
}

template <class Scalar>
Json AnswerToJson(const Answer<Scalar>& answer, int dimension) {
  Json json = EndToJson(answer);
  if (answer.outcome == Outcome::kCycle && dimension == 3)
    json["evidence"] = answer.arithmetic != Arithmetic::kInterval ? kNoProof
                       : answer.reason.empty()                    ? kProofOfSets
                                                                  : kProofOfBox;
  json["method"] = answer.method;
  json["arithmetic"] = Name(answer.arithmetic);
  if (dimension == 3) json["law"] = Name(answer.law);
  if constexpr (kIsExact<Scalar>) {
    if (answer.bound) json["bound"] = ToString(*answer.bound);
  }
  if (!answer.word.empty()) json["word"] = answer.word;
  AddVectors(answer, json);
  if (answer.moves_elsewhere) json["unique_accelerations"] = false;
  if (answer.errors) AddErrors(*answer.errors, json);
  json["statistics"] = CountersToJson(answer.counters);
  if (answer.rung) json["rung"] = Name(*answer.rung);
  return json;
}

Json SuspicionToJson(const InexactAnswer& suspicion) {
  Json json = EndToJson(suspicion);
  json["arithmetic"] = Name(suspicion.arithmetic);
  if (suspicion.errors) AddErrors(*suspicion.errors, json);
  return json;
}

}  // namespace

Json CountersToJson(const Counters& counters) {
  Json json = Json::object();
  counters.ForEach([&json](Counter c, std::int64_t value) { json[Name(c)] = value; });
  return json;
}

std::string_view AnsweredBy(std::string_view method, const Counters& counters) {
  if (method != "fast") return method;
  if (counters[Counter::kFallbacks] > 0) return "complete";
  return counters[Counter::kPublished] > 0 ? "baraff" : method;
}

Json SolutionToJson(const Solution& solution, int dimension) {
  Json json =
      std::visit([dimension](const auto& answer) { return AnswerToJson(answer, dimension); }, solution.answer);
  if (solution.suspected) json["suspected"] = SuspicionToJson(*solution.suspected);
  return json;
}

}  // namespace stiction
