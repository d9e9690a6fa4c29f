// A column under one cycle of a sine (Eq. 23 with p = 1), by Taylor series of one order: for peers.py.
#include <algorithm>
#include <cmath>

namespace {
constexpr int ORDER = 20, LOOKS = 8;
constexpr double AT_REST = 1e-13;  // of α: the height of a bounce that is left out

struct Column {
  double alpha, size, omega, side, time, x[ORDER + 1], top;

  double at(double h) const { double y = x[ORDER]; for (int n = ORDER; n--;) y = y * h + x[n]; return y; }
  double rate(double h) const {
    double y = ORDER * x[ORDER];
    for (int n = ORDER - 1; n; n--) y = y * h + n * x[n];
    return y;
  }
  double push() const { return -side * size * std::sin(omega * time); }

  void expand() {
    double s[ORDER], c[ORDER], f[ORDER], g[ORDER];
    s[0] = std::sin(alpha - x[0]), c[0] = std::cos(alpha - x[0]);
    f[0] = push(), g[0] = -side * size * std::cos(omega * time);
    for (int n = 0; n + 2 <= ORDER; n++) {
      double sum = -s[n], ds = 0.0, dc = 0.0;
      for (int j = 0; j <= n; j++) {
        sum += f[j] * c[n - j];
        ds -= c[n - j] * (j + 1) * x[j + 1];
        dc += s[n - j] * (j + 1) * x[j + 1];
      }
      x[n + 2] = sum / ((n + 1) * (n + 2));
      s[n + 1] = ds / (n + 1), c[n + 1] = dc / (n + 1);
      f[n + 1] = omega * g[n] / (n + 1), g[n + 1] = -omega * f[n] / (n + 1);
    }
  }

  template <class Function> static double root(Function f, double low, double high) {
    const bool falls = f(low) > 0.0;
    for (int n = 0; n < 52 && high - low > 1e-16; n++) {
      const double middle = 0.5 * (low + high);
      ((f(middle) > 0.0) == falls ? low : high) = middle;
    }
    return high;
  }

  // Go to `stop`, to a landing ('l') or until the column lies flat ('f').
  char go(double stop, bool lands, double tolerance) {
    while (time < stop) {
      expand();
      double h = std::min({stop - time, std::pow(tolerance / std::fabs(x[ORDER]), 1.0 / ORDER),
                           std::pow(tolerance / std::fabs(x[ORDER - 1]), 1.0 / (ORDER - 1))});
      if (lands && x[0] == 0.0 && x[2] < 0.0) h = std::min(h, -0.5 * x[1] / x[2]);
      for (int look = 1; look <= LOOKS && lands; look++) {
        const double low = h * (look - 1) / LOOKS, high = h * look / LOOKS;
        if (rate(low) > 0.0 && rate(high) <= 0.0)
          top = std::max(top, at(root([&](double t) { return rate(t); }, low, high)));
        if (at(high) <= 0.0) {
          h = root([&](double t) { return at(t); }, low > 0.0 ? low : 1e-3 * high, high);
          const double v = rate(h);
          time += h, x[0] = 0.0, x[1] = v;
          return 'l';
        }
      }
      const double y = at(h), v = rate(h);
      time = h < stop - time ? time + h : stop, x[0] = y, x[1] = v;
      if (y >= M_PI / 2) return 'f';
    }
    return 0;
  }
};
}  // namespace

// The peak over α; NaN if the column overturns. `amplitude` is over tan α, ω over p.
extern "C" double peak(double alpha, double restitution, double omega, double amplitude, double tolerance) {
  const double level = std::tan(alpha), half = M_PI / omega, lift = std::asin(1.0 / amplitude) / omega;
  Column column{alpha, amplitude * level, omega, 0.0, 0.0, {}, 0.0};
  for (int wave = 0; wave < 2; wave++) {
    const double begin = lift + wave * half;
    if (column.time > begin) continue;
    column.side = wave ? 1.0 : -1.0, column.time = begin, column.x[0] = column.x[1] = 0.0;
    if (column.go(begin + half - 2.0 * lift, false, tolerance)) return NAN;
    while (char event = column.go(2.0 * half, true, tolerance)) {
      if (event == 'f') return NAN;
      column.x[1] *= -restitution, column.side = -column.side;
      const double pull = level - std::fabs(column.push());
      if (pull > 0.0 && column.x[1] * column.x[1] < 2.0 * pull * AT_REST * alpha) break;
    }
    if (column.time < 2.0 * half) continue;
    const double x = column.x[0], v = column.x[1];  // free motion, by energy
    double surplus = v * v / 2 + std::cos(alpha - x) - 1;
    if (x > alpha && (v > 0.0 || surplus < 0.0)) return NAN;
    if (v < 0.0) surplus = (surplus + 1 - std::cos(alpha)) * restitution * restitution - 1 + std::cos(alpha);
    if (surplus >= 0.0) return NAN;
    return std::max({column.top, x, alpha - std::acos(1 + surplus)}) / alpha;
  }
  return column.top / alpha;
}

extern "C" void peaks(double alpha, double r, const double *w, const double *a, int n, double tolerance, double *out) {
  for (int i = 0; i < n; i++) out[i] = peak(alpha, r, w[i], a[i], tolerance);
}
