# The program unfair-toss alone, as the jobs of docs/more-machines.md run it.
FROM rust:1.89-slim-bookworm AS build
WORKDIR /source
COPY . .
RUN cargo install --locked --path crates/cli --root /built

FROM debian:bookworm-slim
COPY --from=build /built/bin/unfair-toss /usr/local/bin/unfair-toss
CMD ["unfair-toss", "--help"]
