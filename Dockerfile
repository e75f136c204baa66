# docker build -t trunnion . && docker run --rm -v "$PWD:/work" trunnion pivot --svg out
FROM debian:12-slim AS build
RUN apt-get update && apt-get install -y --no-install-recommends \
    build-essential cmake ninja-build dpkg-dev file libboost-math-dev libcli11-dev libeigen3-dev \
    libfmt-dev libnlopt-dev libnlopt-cxx-dev libtomlplusplus-dev nettle-dev nlohmann-json3-dev \
    zlib1g-dev pybind11-dev python3-dev python3-numpy
COPY . /source
WORKDIR /source
RUN cmake --preset release -B /build -DTRUNNION_TESTS=OFF -DTRUNNION_BENCHMARKS=OFF \
    -DTRUNNION_PYTHON=ON -DTRUNNION_WARNINGS_ARE_ERRORS=OFF \
 && cmake --build /build && cd /build && cpack -G DEB

FROM debian:12-slim
COPY --from=build /build/trunnion_*.deb /tmp/
RUN apt-get update && apt-get install -y --no-install-recommends /tmp/trunnion_*.deb \
 && rm -rf /tmp/*.deb /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["trunnion"]
