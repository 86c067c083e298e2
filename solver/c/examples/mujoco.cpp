// SPDX-License-Identifier: Apache-2.0
// Steps of MuJoCo with rigid contacts by stiction, of boxes.xml: ten boxes, every other one 100 times as heavy.
#include <mujoco/mujoco.h>
#include <stiction.h>

#include <cstdio>
#include <vector>

// v+ = v + h M^-1 (forces) + M^-1 J' p; contacts may close their gaps within the step.
bool Step(const mjModel* m, mjData* d, stiction_context* context) {
  const double h = m->opt.timestep;
  mj_step1(m, d);  // contacts, J, M
  mj_fwdActuation(m, d);
  mj_fwdAcceleration(m, d);  // qacc_smooth: without contacts
  std::vector<stiction_contact> contacts;
  std::vector<int> row_starts = {0}, columns;
  std::vector<double> values, c, w(m->nv), M(m->nv * m->nv);
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    contacts.push_back({STICTION_STATIC, contact.friction[0], {}});
    for (int k = 0; k < 3; ++k) {
      const double* J = d->efc_J + (contact.efc_address + k) * m->nv;
      for (int j = 0; j < m->nv; ++j) {
        if (J[j] != 0) columns.push_back(j), values.push_back(J[j]);
      }
      row_starts.push_back(static_cast<int>(columns.size()));
      c.push_back(k == 0 ? contact.dist / h : 0);
    }
  }
  mj_fullM(m, M.data(), d->qM);
  mju_addScl(w.data(), d->qvel, d->qacc_smooth, h, m->nv);
  std::vector<double> p(c.size());
  const int count = static_cast<int>(contacts.size());
  const stiction_factors problem = {
      3, count,  contacts.data(), nullptr,  3 * count, m->nv, row_starts.data(), columns.data(), values.data(),
      1, &m->nv, M.data(),        w.data(), c.data()};
  stiction_answer answer = {p.data(), nullptr, d->qvel, {}, 0, nullptr};
  if (stiction_solve(context, &problem, nullptr, &answer) != STICTION_SOLVED) return false;
  mj_integratePos(m, d->qpos, d->qvel, h);
  d->time += h;
  return true;
}

int main(int count, char** words) {
  char error[200] = "expected the name of a model";
  mjModel* m = count == 2 ? mj_loadXML(words[1], nullptr, error, sizeof error) : nullptr;
  if (m == nullptr) return std::puts(error), 2;
  mjData* d = mj_makeData(m);
  stiction_context* context = stiction_create();
  bool solved = true;
  while (solved && d->time < 1) solved = Step(m, d, context);
  mju_subFrom(d->qpos, m->qpos0, m->nq);
  const double moved = mju_norm(d->qpos, m->nq);
  std::printf("%s at %.3f s: moved by %.1g m; %s\n", moved < 1e-3 ? "stands" : "fell", d->time, moved,
              stiction_message(context));
  stiction_destroy(context);
  mj_deleteData(d);
  mj_deleteModel(m);
  return solved && moved < 1e-3 ? 0 : 1;
}
