// SPDX-License-Identifier: Apache-2.0
#include "answers/answer_text.h"

#include "answers/narrate_text.h"

namespace stiction {
namespace {

Json EnclosuresToJson(const std::vector<Enclosure>& values) {
  Json json = Json::array();
  for (const Enclosure& x : values) json.push_back({NumberToJson(x.low), NumberToJson(x.high)});
  return json;
}

template <class Scalar>
void AddVectors(const TracedAnswer<Scalar>& answer, Json& json) {
  if (answer.f_enclosed.empty()) {
    json["f"] = answer.f.size() > 0 || answer.Solved() ? ListJson(answer.f) : Json(nullptr);
    json["a"] = answer.a.size() > 0 || answer.Solved() ? ListJson(answer.a) : Json(nullptr);
  } else {
    json["f"] = EnclosuresToJson(answer.f_enclosed);
    json["a"] = EnclosuresToJson(answer.a_enclosed);
  }
  if (answer.ray.size() > 0) json["ray"] = ListJson(answer.ray);
}

template <class Scalar>
Json AnswerToJson(const TracedAnswer<Scalar>& answer, int dimension) {
  Json json = EndToJson(answer);
  if (answer.outcome == Outcome::kCycle && dimension == 3)
    json["evidence"] = answer.arithmetic == Arithmetic::kInterval ? kProofOfSets : kNoProof;
  json["method"] = answer.method;
  json["arithmetic"] = Name(answer.arithmetic);
  if (dimension == 3) json["law"] = Name(answer.law);
  if (!answer.bound.empty()) json["bound"] = answer.bound;
  if (!answer.word.empty()) json["word"] = answer.word;
  AddVectors(answer, json);
  if (!kIsExact<Scalar> && answer.residual >= 0) json["residual"] = NumberToJson(answer.residual);
  if (answer.backward)
    json["backward_error"] = {{"data", NumberToJson(answer.backward->of_data)},
                              {"b", NumberToJson(answer.backward->of_b)},
                              {"mu", NumberToJson(answer.backward->of_mu)}};
  json["statistics"] = CountersToJson(answer.counters);
  return json;
}

Json SuspicionToJson(const Suspicion& suspicion) {
  Json json = EndToJson(suspicion);
  json["arithmetic"] = Name(suspicion.arithmetic);
  if (suspicion.residual >= 0) json["residual"] = NumberToJson(suspicion.residual);
  return json;
}

}  // namespace

Json CountersToJson(const std::vector<Counter>& counters) {
  Json json = Json::object();
  for (const Counter& counter : counters) json[std::string(counter.name)] = counter.value;
  return json;
}

Json SolutionToJson(const Solution& solution, int dimension) {
  Json json =
      std::visit([dimension](const auto& answer) { return AnswerToJson(answer, dimension); }, solution.answer);
  if (solution.rung) json["rung"] = Name(*solution.rung);
  if (solution.suspected) json["suspected"] = SuspicionToJson(*solution.suspected);
  return json;
}

}  // namespace stiction
