# Sourced by tests that use npm packages of other people.

not_run() {  # WORDS: ends a test that this machine cannot run
  echo "not run: $1"
  exit 77
}

install_npm_packages() {  # SOURCE WORK PACKAGE: those of SOURCE/package-lock.json, which has PACKAGE, once into WORK
  command -v node >/dev/null && command -v npm >/dev/null || not_run "no node and npm; install nodejs and npm"
  mkdir -p "$2"
  if cmp -s "$1/package-lock.json" "$2/package-lock.json" && [ -e "$2/installed" ]; then return; fi
  rm -f "$2/installed"
  cp "$1/package.json" "$1/package-lock.json" "$2/"
  (cd "$2" && npm ci --no-audit --no-fund >npm.log 2>&1 && node -e "require('$3')" >>npm.log 2>&1) ||
    not_run "npm ci fails, see $2/npm.log: $(grep -m 1 -iE 'error' "$2/npm.log" || true)"
  touch "$2/installed"
}
