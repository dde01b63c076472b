# The match server. For x86-64 processors of 2013 and later (x86-64-v3); games are kept in the volume /data.
FROM python:3.12.12-slim-bookworm AS build
WORKDIR /source
COPY locks locks
RUN pip install --require-hashes -r locks/build.txt
COPY pyproject.toml README.md LICENSE ./
COPY physics physics
COPY pictures pictures
COPY calibration calibration
COPY referee referee
COPY tournament tournament
COPY protocol protocol
COPY server server
COPY client client
RUN pip wheel --no-deps --no-build-isolation --wheel-dir /wheels .

FROM python:3.12.12-slim-bookworm
ENV PIP_NO_CACHE_DIR=1 PYTHONUNBUFFERED=1
# numba caches per processor: both must be set for kernels compiled here to be found on another machine.
ENV NUMBA_CPU_NAME=x86-64-v3 NUMBA_CPU_FEATURES=""
ENV POOLIAD_CACHE_DIR=/var/cache/pooliad POOLIAD_DATABASE=sqlite:////data/pooliad.db
COPY --from=build /source/locks/server.txt /wheels/server.txt
RUN pip install --require-hashes -r /wheels/server.txt
COPY --from=build /wheels /wheels
RUN pip install --no-deps /wheels/pooliad-*.whl
RUN install -d -o 10001 -g 10001 /data /var/cache/pooliad
USER 10001:10001
# The self-tests leave every kernel the server needs compiled in the cache.
RUN pooliad doctor --jaws --database sqlite:////data/pooliad.db
WORKDIR /data
VOLUME /data
EXPOSE 8080
HEALTHCHECK --interval=10s --timeout=5s --start-period=20s \
  CMD ["python", "-c", "import urllib.request; urllib.request.urlopen('http://127.0.0.1:8080/healthz', timeout=4)"]
CMD ["pooliad", "serve", "--host", "0.0.0.0", "--port", "8080"]
