// Pinocchio's articulated-body algorithm over casadi::SX: pinocchio.casadi, which the wheels of PyPI leave out, from
// the same headers. Writes the C of a function (y, t) -> qdd, and the function itself for who reads it in Python; prints
// the CPU seconds of deriving and of printing.
//
//     pinocchio_codegen chain8|arm local|world OUT
#include <pinocchio/autodiff/casadi.hpp>
#include <pinocchio/algorithm/aba.hpp>

#include "pinocchio_models.hpp"

#include <casadi/casadi.hpp>
#include <cstdio>
#include <ctime>
#include <fstream>

using casadi::SX;

static double seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

int main(int count, char** words) {
    if (count != 4) return 2;
    const std::string task = words[1], frame = words[2], out = words[3];
    const double start = seconds();
    const Machine machine = machine_of(task);
    const auto model = machine.model.cast<SX>();
    pinocchio::DataTpl<SX> data(model);
    const int n = model.nv;
    const SX y = SX::sym("y", 2 * n), t = SX::sym("t");
    Eigen::Matrix<SX, Eigen::Dynamic, 1> q(n), v(n), tau(n);
    for (int i = 0; i < n; ++i) {
        // Absolute angles come in: the joints' are their differences.
        const bool relative = machine.absolute && i > 0;
        q[i] = relative ? y(i) - y(i - 1) : y(i);
        v[i] = relative ? y(n + i) - y(n + i - 1) : y(n + i);
        tau[i] = -machine.friction * v[i];
    }
    const auto convention = frame == "local" ? pinocchio::Convention::LOCAL : pinocchio::Convention::WORLD;
    pinocchio::aba(model, data, q, v, tau, convention);
    SX qdd = SX::zeros(n);
    for (int i = 0; i < n; ++i) qdd(i) = data.ddq[i] + (machine.absolute && i > 0 ? qdd(i - 1) : SX(0));
    const casadi::Function function("f", {y, t}, {SX::cse(std::vector<SX>{qdd})[0]});
    const double derived = seconds();
    casadi::CodeGenerator generator("f");
    generator.add(function);
    std::ofstream(out + ".c") << generator.dump();
    std::printf("%.6f %.6f\n", derived - start, seconds() - derived);
    function.save(out + ".casadi");
}
