// SPDX-License-Identifier: Apache-2.0
#include "cli/narration/safety.h"

#include <fmt/format.h>

#include "certify/claims/certificate.h"
#include "certify/claims/condition.h"
#include "certify/claims/safe.h"
#include "certify/claims/safety_threshold.h"
#include "certify/claims/witness.h"
#include "corpus/grouped.h"
#include "corpus/json.h"

namespace stiction {

// ["slip-", "stick"] -> "slip- stick".
std::string WordText(const Json& word) {
  std::string text;
  for (const Json& mode : word) text += (text.empty() ? "" : " ") + mode.get<std::string>();
  return text;
}

namespace {

Json ThresholdToJson(const SafetyThreshold& threshold) {
  Json polynomial = Json::array();
  for (const Rational& coefficient : threshold.polynomial) polynomial.push_back(ToString(coefficient));
  return {{"low", ToString(threshold.low)},
          {"high", ToString(threshold.high)},
          {"word", WordToJson(threshold.word)},
          {"polynomial", polynomial}};
}

// By the determinants of all words, and for which uniform friction they are positive.
void AddWords(const ExactProblem& problem, Json& result) {
  result["safe"] = !DecideSafety(problem).unsafe_word.has_value();
  result["by"] = "words";
  if (const auto threshold = FindSafetyThreshold(problem)) result["threshold"] = ThresholdToJson(*threshold);
}

// What can be said of a problem that is not safe since determinants vanish.
void AddWeakSafety(const ExactProblem& problem, Json& result) {
  const WeakSafety weak = DecideWeakSafety(problem);
  result["weakly_safe"] = !weak.negative_word;
  result["vanishing_words"] = weak.vanishing;
  if (weak.negative_word) result["negative_word"] = WordToJson(*weak.negative_word);
  result["limit"] = {{"safe", !weak.limit_word}};
  if (weak.limit_word) result["limit"]["word"] = WordToJson(*weak.limit_word);
  if (const auto threshold = FindLimitThreshold(problem)) {
    result["limit"]["threshold"] = ThresholdToJson(*threshold);
  }
}

// By the condition number of A after scaling: any number of contacts.
void AddCondition(const ExactProblem& problem, Json& result) {
  const auto bound = FindConditionBound(problem, FrictionWeights::kUniform);
  if (!bound) return;
  const auto mu = bound->SafeFriction();
  result["condition"] = {{"number", ToString(Rational(bound->most / bound->least))},
                         {"scaling", ListJson(bound->scaling)},
                         {"mu", mu ? Json(ToString(*mu)) : Json()}};
}

std::string ThresholdText(const Json& threshold) {
  return fmt::format("mu* in [{}, {}], by {}", threshold["low"].get<std::string>(),
                     threshold["high"].get<std::string>(), WordText(threshold["word"]));
}

std::string WeakSafetyText(const Json& result) {
  const Json& limit = result["limit"];
  std::string text =
      limit["safe"].get<bool>()
          ? "safe in the limit: A + eps I is safe for all small eps > 0\n"
          : fmt::format("not safe in the limit: A + eps I is unsafe by {}\n", WordText(limit["word"]));
  return text + (limit.contains("threshold")
                     ? "uniform mu: safe in the limit below " + ThresholdText(limit["threshold"]) + "\n"
                     : "safe in the limit for every uniform mu > 0\n");
}

std::string ConditionText(const Json& condition) {
  const Json& mu = condition["mu"];
  if (mu.is_null()) return "its condition alone: safe for every uniform mu\n";
  return fmt::format("its condition alone: safe for uniform mu <= {}\n", mu.get<std::string>());
}

}  // namespace

Json SafetyOf(const ExactProblem& problem) {
  Json result = {{"safe", nullptr}};
  if (HasFewWords(problem)) {
    AddWords(problem, result);
  } else if (ConditionCertificate(problem)) {
    result = {{"safe", true}, {"by", "condition"}};
  }
  if (result["safe"] == false && HasFewWords(problem, kMaxWeakSafetyWords)) AddWeakSafety(problem, result);
  AddCondition(problem, result);
  return result;
}

std::string SafetySentence(const Json& safety) {
  const Json& safe = safety["safe"];
  if (safe.is_null())
    return "perhaps safe, which is not decided: too many words, and the condition does not tell";
  if (safe == true)
    return "safe: the determinants of all words are positive; complete driving has no fold, and the published "
           "algorithm under apex=suspended, ties apart, nothing to give up";
  if (!safety.contains("weakly_safe"))
    return "unsafe: the determinant of a word is zero or negative; where one is negative, complete driving may "
           "fold, and the published algorithm give up";
  if (safety["weakly_safe"] == true)
    return fmt::format(
        "weakly safe: the determinants of {} are zero, and none is negative; complete driving neither "
        "folds nor descends",
        Counted(safety["vanishing_words"].get<int>(), "word"));
  return fmt::format(
      "unsafe: the determinant of a word is negative ({}); complete driving may fold, and the published "
      "algorithm give up",
      WordText(safety["negative_word"]));
}

std::string SafetyText(const Json& safety) {
  std::string text = SafetySentence(safety) + "\n";
  if (safety.contains("threshold")) {
    text += "uniform mu: safe below " + ThresholdText(safety["threshold"]) + "\n";
  } else if (safety.value("by", "") == "words") {
    text += "safe for every uniform mu > 0\n";
  }
  if (safety.contains("limit")) text += WeakSafetyText(safety);
  if (safety["safe"] == false && !safety.contains("limit"))
    text += "weakly safe, safe in the limit: not looked at, too many words\n";
  if (safety.contains("condition")) text += ConditionText(safety["condition"]);
  return text;
}

}  // namespace stiction
