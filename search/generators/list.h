// SPDX-License-Identifier: Apache-2.0
// The generators by name, in the order of their ids, which recorded draws depend on: a new one is added at the
// end.
//
// NAME is GeneratorId::kNAME, and MakeNAME() (generator.h) is in the file of the generator.

#pragma once

#define STICTION_GENERATORS(X) \
  X(Integers)                  \
  X(Psd)                       \
  X(Small)                     \
  X(NearDegenerate)            \
  X(Duplicates)                \
  X(Conditioned)               \
  X(Bodies)                    \
  X(Exponential)               \
  X(Scenes)                    \
  X(FineScenes)                \
  X(OneBody)                   \
  X(Bilateral)                 \
  X(Sliding)                   \
  X(Space)                     \
  X(Exceptional)               \
  X(Steps)                     \
  X(Game)
